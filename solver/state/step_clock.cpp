#include "solver/state/step_clock.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

#include "geometry/text/write_number.hpp"

namespace ashlar {
namespace {

/// Whole numbers up to this value, and powers of ten up to 10^22, are exact in double precision: their quotient and
/// product are rounded once.
constexpr std::int64_t largest_exact = std::int64_t{1} << 53;
constexpr int largest_power = 22;
/// Difference of times that are equal, at least in time steps, and in rounding errors of the end: larger values leave out
/// the last short step of a run, smaller ones take one of no length.
constexpr double least_time_share = 1e-9, rounding_errors_of_time = 4.0;

struct Decimal {
  std::int64_t digits = 0;
  int exponent = 0;  ///< value: digits x 10^exponent
};

/// The shortest decimal representation of a double, without trailing zeros.
std::optional<Decimal> shortest_decimal(double value) {
  if (value == 0.0) return Decimal{};
  std::array<char, longest_number> text;
  const char* const end = write_number(text.data(), value, NumberForm::scientific);
  Decimal decimal;
  bool negative = false, after_point = false;
  const char* at = text.data();
  for (; at != end && *at != 'e'; ++at) {
    if (*at == '-') negative = true;
    if (*at == '.') after_point = true;
    if (*at < '0' || *at > '9') continue;
    decimal.digits = 10 * decimal.digits + (*at - '0');
    if (after_point) --decimal.exponent;
  }
  if (at == end) return std::nullopt;  // no number
  const char* exponent = at + (at[1] == '+' ? 2 : 1);
  int power = 0;
  std::from_chars(exponent, end, power);
  decimal.exponent += power;
  if (negative) decimal.digits = -decimal.digits;
  return decimal;
}

std::optional<std::int64_t> product(std::int64_t a, std::int64_t b) {
  if (a != 0 && std::abs(b) > largest_exact / std::abs(a)) return std::nullopt;
  return a * b;
}

/// digits x 10^exponent in units of 10^unit, unit <= exponent.
std::optional<std::int64_t> in_units(std::int64_t digits, int exponent, int unit) {
  std::optional<std::int64_t> result = digits;
  for (int k = unit; result && *result != 0 && k < exponent; ++k) result = product(*result, 10);
  return result;
}

/// 0 <= exponent <= largest_power
double power_of_ten(int exponent) {
  double power = 1.0;
  for (int k = 0; k < exponent; ++k) power *= 10.0;
  return power;
}

}  // namespace

double decimal_sum(double start, std::int64_t count, double step) {
  const double rounded = start + static_cast<double>(count) * step;
  const std::optional<Decimal> from = shortest_decimal(start), of = shortest_decimal(step);
  if (!from || !of) return rounded;
  const std::optional<std::int64_t> change = product(of->digits, count);
  if (!change) return rounded;
  int unit = *change == 0 ? from->exponent : of->exponent;
  if (from->digits != 0) unit = std::min(unit, from->exponent);
  if (std::abs(unit) > largest_power) return rounded;
  const std::optional<std::int64_t> first = in_units(from->digits, from->exponent, unit);
  const std::optional<std::int64_t> second = in_units(*change, of->exponent, unit);
  if (!first || !second || std::abs(*first + *second) > largest_exact) return rounded;
  const auto sum = static_cast<double>(*first + *second);
  return unit < 0 ? sum / power_of_ten(-unit) : sum * power_of_ten(unit);
}

double StepClock::time() const {
  return count == 0 ? start : decimal_sum(start, count, step);
}

double StepClock::time_after(double length) const {
  if (length == 0.0) return time();
  return length == step ? decimal_sum(start, count + 1, step) : decimal_sum(time(), 1, length);
}

void StepClock::advance(double length) {
  if (length == 0.0) return;
  if (length != step) *this = {time(), length, 0};
  ++count;
}

double time_rounding(double time_step, double end_time) {
  return std::max(least_time_share * time_step,
                  rounding_errors_of_time * std::numeric_limits<double>::epsilon() * std::abs(end_time));
}

}  // namespace ashlar
