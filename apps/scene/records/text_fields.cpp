#include "apps/scene/records/text_fields.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/text/parse_number.hpp"

namespace ashlar {
namespace {

/// Fields between runs of blanks.
std::vector<TextField> words_of(std::string_view line) {
  constexpr std::string_view blanks = " \t\r";
  std::vector<TextField> words;
  for (std::size_t start = 0; (start = line.find_first_not_of(blanks, start)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blanks, start), line.size());
    words.push_back({line.substr(start, end - start), static_cast<int>(start) + 1});
    start = end;
  }
  return words;
}

}  // namespace

std::string_view trimmed_text(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<TextField> fields_of(std::string_view line, char separator) {
  if (separator == ' ') return words_of(line);
  std::vector<TextField> fields;
  std::size_t start = 0;
  while (true) {
    const std::size_t end = std::min(line.find(separator, start), line.size());
    std::string_view text = trimmed_text(line.substr(start, end - start));
    const std::size_t column = text.empty() ? start : static_cast<std::size_t>(text.data() - line.data());
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
    fields.push_back({text, static_cast<int>(column) + 1});
    if (end == line.size()) return fields;
    start = end + 1;
  }
}

char separator_of(std::string_view line) {
  for (const char separator : {';', '\t', ','})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

std::optional<double> number_of(std::string_view digits) {
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double value = 0.0;
  const auto [stop, status] = parse_number(digits.data(), digits.data() + digits.size(), value);
  if (status != std::errc() || stop != digits.data() + digits.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

}  // namespace ashlar
