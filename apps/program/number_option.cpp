#include "apps/program/number_option.hpp"

#include <fmt/format.h>

#include <cmath>
#include <system_error>

namespace ashlar {
namespace {

/// The text as a single number. @throws CLI::ValidationError if it is none
template <class T>
T single_number(const std::string& text, std::string_view words) {
  const std::string_view digits =
      text.size() > 1 && text[0] == '+' && text[1] != '-' ? std::string_view(text).substr(1) : text;
  T value{};
  const auto [end, error] = parse_number(digits.data(), digits.data() + digits.size(), value);
  if (end != digits.data() + digits.size() || error == std::errc::invalid_argument)
    throw CLI::ValidationError(
        fmt::format("value is no number of this kind ({}), {} is needed", text, words));
  if (error != std::errc())
    throw CLI::ValidationError(fmt::format("value is out of range ({}), {} is needed", text, words));
  return value;
}

/// A text that CLI11 reads as exactly this value, whatever the decimal point of the language: "0x1p-1".
std::string exact_text(double value) {
  constexpr int mantissa_digits = std::numeric_limits<double>::digits;
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(std::abs(value), &exponent), mantissa_digits);
  return fmt::format("{}0x{:x}p{}", std::signbit(value) ? "-" : "", static_cast<std::uint64_t>(mantissa),
                     exponent - mantissa_digits);
}

}  // namespace

CLI::Validator whole_number_option(std::uint64_t low, std::uint64_t high) {
  const bool unlimited = high == largest_int;
  const std::string words = unlimited ? fmt::format("a whole number of at least {}", low)
                                      : fmt::format("a whole number from {} to {}", low, high);
  return {[=](std::string& text) {
            const auto value = single_number<std::uint64_t>(text, words);
            if (value < low || value > high)
              return fmt::format("value is out of range ({}), {} is needed", text, words);
            text = std::to_string(value);
            return std::string();
          },
          unlimited ? fmt::format(">= {}", low) : fmt::format("{} to {}", low, high)};
}

CLI::Validator real_number_option(RealOptionRange range) {
  return {[=](std::string& text) {
            const auto value = single_number<double>(text, range.words);
            const bool above = range.low_allowed ? value >= range.low : value > range.low;
            if (!std::isfinite(value) || !above || value > range.high)
              return fmt::format("value is out of range ({}), {} is needed", text, range.words);
            text = exact_text(value);
            return std::string();
          },
          ""};
}

}  // namespace ashlar
