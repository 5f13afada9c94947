#include "apps/scene/model/diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <set>
#include <string_view>
#include <tuple>

namespace ashlar {

std::string to_string(const Place& place) {
  if (place.line == 0) return place.origin;
  return fmt::format("{}:{}:{}", place.origin, place.line, place.column);
}

/// Shortens a line in the middle if the user's names or values make it too long.
static std::string shortened(std::string line) {
  if (line.size() <= longest_line) return line;
  const auto inside_letter = [&](std::size_t byte) {
    return (static_cast<unsigned char>(line[byte]) & 0xC0U) == 0x80U;  // UTF-8
  };
  std::size_t head = longest_line / 2, tail = line.size() - longest_line / 2;
  while (head > 0 && inside_letter(head)) --head;
  while (tail < line.size() && inside_letter(tail)) ++tail;
  return fmt::format("{} [... {} bytes ...] {}", std::string_view(line).substr(0, head), tail - head,
                     std::string_view(line).substr(tail));
}

std::string to_string(const Diagnostic& diagnostic) {
  std::string line =
      fmt::format("{}: {}: {}", to_string(diagnostic.place),
                  diagnostic.severity == Severity::error ? "error" : "warning", diagnostic.message);
  line = shortened(std::move(line));
  // The user's values may contain line breaks.
  std::replace_if(
      line.begin(), line.end(), [](unsigned char letter) { return letter < ' '; }, ' ');
  return line;
}

/// Beginning of a message before any name or number of the user's: in parentheses, in quotes, or digits.
static std::string_view kind_of(const Diagnostic& diagnostic) {
  std::string_view kind = diagnostic.message;
  kind = kind.substr(0, kind.find_first_of("(\"0123456789"));
  while (kind.ends_with(' ')) kind.remove_suffix(1);
  return kind;
}

bool Diagnostics::good() const {
  return std::none_of(all_.begin(), all_.end(),
                      [](const Diagnostic& d) { return d.severity == Severity::error; });
}

std::vector<Diagnostic> Diagnostics::sorted() const {
  const auto order = [](const Diagnostic& d) {
    return std::tuple(d.place.line == 0, d.place.line, d.place.column);
  };
  std::vector<Diagnostic> result;
  std::set<std::tuple<std::string_view, int, int, std::string_view>> listed;
  for (const Diagnostic& diagnostic : all_) {
    const auto& [origin, line, column] = diagnostic.place;
    if (listed.emplace(origin, line, column, diagnostic.message).second) result.push_back(diagnostic);
  }
  std::stable_sort(result.begin(), result.end(),
                   [&](const Diagnostic& a, const Diagnostic& b) { return order(a) < order(b); });
  return result;
}

std::vector<Diagnostic> Diagnostics::listed() const {
  struct Kind {
    std::size_t count = 0;
    const Diagnostic* first_hidden = nullptr;
  };
  const std::vector<Diagnostic> all = sorted();
  std::vector<Diagnostic> result;
  std::map<std::pair<Severity, std::string_view>, Kind> kinds;
  for (const Diagnostic& diagnostic : all) {
    Kind& kind = kinds[{diagnostic.severity, kind_of(diagnostic)}];
    if (++kind.count <= listed_of_a_kind)
      result.push_back(diagnostic);
    else if (kind.first_hidden == nullptr)
      kind.first_hidden = &diagnostic;
  }
  for (const auto& [name, kind] : kinds) {
    if (kind.first_hidden == nullptr) continue;
    result.push_back({kind.first_hidden->place,
                      fmt::format("{} more of this kind from here on ({}), the first {} are listed",
                                  kind.count - listed_of_a_kind, name.second, listed_of_a_kind),
                      name.first});
  }
  return result;
}

void Diagnostics::print(std::ostream& stream) const {
  for (const Diagnostic& diagnostic : listed()) stream << to_string(diagnostic) << '\n';
}

}  // namespace ashlar
