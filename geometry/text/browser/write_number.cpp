// The standard library of emscripten has no std::to_chars for real numbers. The digits are fmt's, which are the shortest too.
#include "geometry/text/write_number.hpp"

#define FMT_HEADER_ONLY
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace ashlar {
namespace {

/// A positive number: 0.digits x 10^exponent.
struct Digits {
  std::string digits;
  int exponent = 0;
};

Digits digits_of(double value) {
  const std::string text = fmt::format("{}", value);
  const std::size_t mantissa = std::min(text.find('e'), text.size());
  Digits found;
  if (mantissa < text.size()) found.exponent = std::stoi(text.substr(mantissa + 1));
  const std::size_t point = std::min(text.find('.'), mantissa);
  found.exponent += static_cast<int>(point);
  found.digits = text.substr(0, point);
  if (point < mantissa) found.digits += text.substr(point + 1, mantissa - point - 1);
  const std::size_t zeros = std::min(found.digits.find_first_not_of('0'), found.digits.size() - 1);
  found.digits.erase(0, zeros);
  found.exponent -= static_cast<int>(zeros);
  while (found.digits.size() > 1 && found.digits.back() == '0') found.digits.pop_back();
  if (value == 0.0) found.exponent = 1;
  return found;
}

std::string scientific(const Digits& number) {
  std::string text = number.digits.substr(0, 1);
  if (number.digits.size() > 1) text += '.' + number.digits.substr(1);
  const int exponent = number.exponent - 1;
  return text + fmt::format("e{}{:02}", exponent < 0 ? '-' : '+', std::abs(exponent));
}

/// @param value the number: digits behind those that matter are its own, not zeros
std::string fixed(const Digits& number, double value) {
  const auto size = static_cast<int>(number.digits.size());
  if (number.exponent <= 0)
    return "0." + std::string(static_cast<std::size_t>(-number.exponent), '0') + number.digits;
  if (number.exponent >= size) return fmt::format("{:.0f}", value);
  std::string text = number.digits;
  return text.insert(static_cast<std::size_t>(number.exponent), 1, '.');
}

std::string text_of(double value, NumberForm form) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return "inf";
  const Digits number = digits_of(value);
  const std::string exponential = scientific(number);
  if (form == NumberForm::scientific) return exponential;
  // Fixed texts of very small and large numbers are long, and are not needed.
  constexpr int longest_fixed = longest_number - 8;
  if (form == NumberForm::shorter && std::abs(number.exponent) > longest_fixed) return exponential;
  std::string plain = fixed(number, value);
  return form == NumberForm::fixed || plain.size() <= exponential.size() ? plain : exponential;
}

}  // namespace

char* write_number(char* begin, double value, NumberForm form) {
  if (std::signbit(value)) *begin++ = '-';
  const std::string text = text_of(std::abs(value), form);
  return std::copy(text.begin(), text.end(), begin);
}

}  // namespace ashlar
