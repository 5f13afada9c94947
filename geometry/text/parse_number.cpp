#include "geometry/text/parse_number.hpp"

#include <algorithm>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

namespace ashlar {
namespace {

bool is_decimal_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Parts of the number at the start of a text.
struct NumberText {
  std::size_t end = 0;                         ///< 0: there is none
  std::size_t point = std::string_view::npos;  ///< of its decimal point
  bool zero = true;                            ///< all its digits are
};

std::size_t end_of_digits(std::string_view text, std::size_t from) {
  while (from < text.size() && is_decimal_digit(text[from])) ++from;
  return from;
}

NumberText number_at_start(std::string_view text) {
  NumberText number;
  const std::size_t start = text.starts_with('-') ? 1 : 0;
  std::size_t at = end_of_digits(text, start);
  std::size_t digits = at - start;
  if (at < text.size() && text[at] == '.') {
    const std::size_t after = end_of_digits(text, at + 1);
    digits += after - at - 1;
    if (digits > 0) {
      number.point = at;
      at = after;
    }
  }
  if (digits == 0) return {};
  number.zero = text.substr(start, at - start).find_first_of("123456789") == std::string_view::npos;
  number.end = at;
  if (at == text.size() || (text[at] != 'e' && text[at] != 'E')) return number;
  const bool is_signed = at + 1 < text.size() && (text[at + 1] == '+' || text[at + 1] == '-');
  const std::size_t power = at + 1 + (is_signed ? 1 : 0);
  if (const std::size_t end = end_of_digits(text, power); end > power) number.end = end;
  return number;
}

bool starts_with_word(std::string_view text, std::string_view word) {
  return text.size() >= word.size() && std::equal(word.begin(), word.end(), text.begin(), [](char a, char b) {
           return a == (b >= 'A' && b <= 'Z' ? b - 'A' + 'a' : b);
         });
}

/// "inf", "infinity", "nan" and "nan(letters)" after an optional minus.
std::from_chars_result parse_word(std::string_view text, double& value) {
  const bool negative = text.starts_with('-');
  const std::string_view rest = text.substr(negative ? 1 : 0);
  std::size_t size = 0;
  double found = std::numeric_limits<double>::infinity();
  for (const std::string_view word : {"infinity", "inf"})
    if (size == 0 && starts_with_word(rest, word)) size = word.size();
  if (starts_with_word(rest, "nan")) {
    found = std::numeric_limits<double>::quiet_NaN();
    size = 3;
    const auto is_letter = [](char c) {
      return is_decimal_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    };
    const auto end =
        std::find_if_not(rest.begin() + std::min<std::size_t>(rest.size(), 4), rest.end(), is_letter);
    if (rest.size() > 3 && rest[3] == '(' && end != rest.end() && *end == ')')
      size = static_cast<std::size_t>(end - rest.begin()) + 1;
  }
  if (size == 0) return {text.data(), std::errc::invalid_argument};
  value = std::copysign(found, negative ? -1.0 : 1.0);
  return {rest.data() + size, std::errc()};
}

}  // namespace

std::from_chars_result parse_real_by_strtod(const char* begin, const char* end, double& value) {
  const std::string_view text(begin, static_cast<std::size_t>(end - begin));
  const NumberText number = number_at_start(text);
  if (number.end == 0) return parse_word(text, value);
  std::string copy(text.substr(0, number.end));
  // The C library reads the point of the program's language.
  if (number.point != std::string_view::npos) copy.replace(number.point, 1, std::localeconv()->decimal_point);
  const double found = std::strtod(copy.c_str(), nullptr);
  const char* const after = begin + number.end;
  if (std::isinf(found) || (found == 0.0 && !number.zero)) return {after, std::errc::result_out_of_range};
  value = found;
  return {after, std::errc()};
}

}  // namespace ashlar
