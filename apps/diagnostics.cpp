#include "apps/diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <tuple>

namespace ashlar {

std::string to_string(const Place& place) {
  if (place.line == 0) return place.origin;
  return fmt::format("{}:{}:{}", place.origin, place.line, place.column);
}

std::string to_string(const Diagnostic& diagnostic) {
  std::string line =
      fmt::format("{}: {}: {}", to_string(diagnostic.place),
                  diagnostic.severity == Severity::error ? "error" : "warning", diagnostic.message);
  // Values of the user may hold line breaks.
  std::replace_if(
      line.begin(), line.end(), [](unsigned char letter) { return letter < ' '; }, ' ');
  return line;
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
  for (const Diagnostic& diagnostic : all_) {
    const auto same = [&](const Diagnostic& d) {
      return d.place == diagnostic.place && d.message == diagnostic.message;
    };
    if (std::none_of(result.begin(), result.end(), same)) result.push_back(diagnostic);
  }
  std::stable_sort(result.begin(), result.end(),
                   [&](const Diagnostic& a, const Diagnostic& b) { return order(a) < order(b); });
  return result;
}

void Diagnostics::print(std::ostream& stream) const {
  for (const Diagnostic& diagnostic : sorted()) stream << to_string(diagnostic) << '\n';
}

}  // namespace ashlar
