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

}  // namespace ashlar
