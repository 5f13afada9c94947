#include "apps/csv_text.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace ashlar {

void append_csv_number(std::string& text, double value) {
  std::array<char, 32> digits;
  char* const begin = digits.data();
  char* const end = begin + digits.size();
  const bool whole = std::trunc(value) == value && std::abs(value) < 1e15;
  const auto result =
      whole ? std::to_chars(begin, end, value, std::chars_format::fixed) : std::to_chars(begin, end, value);
  text.append(begin, result.ptr);
}

std::string quote_csv_field(std::string_view field) {
  if (field.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(field);
  std::string quoted = "\"";
  for (const char c : field) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::vector<std::string> split_csv_line(std::string_view line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += '"';
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

}  // namespace ashlar
