// Second rung of the predicate ladder: an unevaluated sum of two doubles (106 bits) with a bound of its
// error.
//
// Built on the error-free transformations of Knuth (sum) and Dekker (product), exact under rounding to
// nearest while nothing under- or overflows (NumericRange). Whatever an operation drops is added to the
// bound, so a bound of zero means that the value is exact: zeros of short coordinates are decided here.
#pragma once

#include <cmath>
#include <optional>
#include <utility>

#include "geometry/exact/tracked_number.hpp"

namespace ashlar {

/// a + b = first + second exactly, first = fl(a + b).
[[nodiscard]] inline std::pair<double, double> exact_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// a b = first + second exactly, first = fl(a b).
[[nodiscard]] inline std::pair<double, double> exact_product(double a, double b) {
  const double product = a * b;
#ifdef __FMA__
  return {product, std::fma(a, b, -product)};
#else
  constexpr double splitter = 0x1p27 + 1.0;
  const double a_scaled = splitter * a, b_scaled = splitter * b;
  const double a_high = a_scaled - (a_scaled - a), b_high = b_scaled - (b_scaled - b);
  const double a_low = a - a_high, b_low = b - b_high;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
#endif
}

/// |true - (high + low)| <= error * (1 + 2^-30), |low| <= ulp(high) / 2.
struct DoubleDouble {
  double high = 0.0;
  double low = 0.0;
  double error = 0.0;

  DoubleDouble() = default;
  explicit DoubleDouble(double exact) : high(exact) {}
  DoubleDouble(double h, double l, double bound) : high(h), low(l), error(bound) {}

  /// a - b for two exact doubles; exact.
  static DoubleDouble difference(double a, double b) {
    const auto [upper, lower] = exact_sum(a, -b);
    return {upper, lower, 0.0};
  }
  friend DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low, a.error}; }
  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const auto [s, t] = exact_sum(a.high, b.high);
    const auto [p, dropped] = exact_sum(a.low, b.low);
    const auto [q, dropped_too] = exact_sum(t, p);
    const auto [upper, lower] = exact_sum(s, q);
    return {upper, lower, a.error + b.error + (std::abs(dropped) + std::abs(dropped_too))};
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + (-b); }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const auto [p, q] = exact_product(a.high, b.high);
    const double inherited = (std::abs(a.high) + std::abs(a.low)) * b.error +
                             (std::abs(b.high) + std::abs(b.low) + b.error) * a.error;
    if (a.low == 0.0 && b.low == 0.0) return {p, q, inherited};
    const double one = a.high * b.low, other = a.low * b.high, both = one + other;
    const auto [tail, dropped] = exact_sum(q, both);
    const auto [upper, lower] = exact_sum(p, tail);
    const double rounded = TrackedNumber::unit_roundoff * (std::abs(one) + std::abs(other) + std::abs(both)) +
                           std::abs(a.low * b.low) + std::abs(dropped);
    return {upper, lower, inherited + rounded};
  }
};

/// -1, 0, 1, or unknown_sign.
[[nodiscard]] inline int sign_of(const DoubleDouble& a) {
  const double bound = a.error * (1.0 + 0x1p-29);
  if (a.high > bound) return 1;  // the low part is below 2^-53 of the high one, which the factor covers
  if (a.high < -bound) return -1;
  return a.high == 0.0 && bound == 0.0 ? 0 : unknown_sign;
}

/// numerator / denominator, with the same meaning of the bound; nullopt where the operands do not allow one
/// (denominator perhaps zero, or so small that a remainder could underflow).
[[nodiscard]] inline std::optional<DoubleDouble> quotient(const DoubleDouble& numerator,
                                                          const DoubleDouble& denominator) {
  constexpr double smallest = 0x1p-800;
  if (sign_of(numerator) == 0 && sign_of(denominator) != unknown_sign) return DoubleDouble();
  const double least = std::abs(denominator.high) - std::abs(denominator.low) - 2.0 * denominator.error;
  if (!(least > 0.5 * std::abs(denominator.high)) || least < smallest || std::abs(numerator.high) < smallest)
    return std::nullopt;
  const double first = numerator.high / denominator.high;
  DoubleDouble rest = numerator - denominator * DoubleDouble(first);
  const double second = rest.high / denominator.high;
  // A product with the low part that underflows would lose digits no bound counts.
  constexpr double smallest_product = 0x1p-960;
  for (const double factor : {first, second}) {
    const double product = denominator.low * factor;
    if (denominator.low != 0.0 && factor != 0.0 && std::abs(product) < smallest_product) return std::nullopt;
  }
  rest = rest - denominator * DoubleDouble(second);
  const auto [high, low] = exact_sum(first, second);
  const double remainder = std::abs(rest.high) + std::abs(rest.low) + rest.error;
  if (std::abs(high) < 0x1p-400) return std::nullopt;  // products with it could underflow
  return DoubleDouble(high, low, remainder / least);
}

/// Square root of a >= 0; nullopt where a may be zero without being known to be.
[[nodiscard]] inline std::optional<DoubleDouble> square_root(const DoubleDouble& a) {
  const int sign = sign_of(a);
  if (sign == 0) return DoubleDouble();
  if (sign != 1 || a.error > 0x1p-40 * a.high) return std::nullopt;
  // sqrt(a) = s + (a - s^2) / (s + sqrt(a)); replacing the denominator by 2s costs at most (a - s^2)^2 / s^3.
  const double root = std::sqrt(a.high);
  const auto [p, q] = exact_product(root, root);
  const DoubleDouble rest = a - DoubleDouble(p, q, 0.0);
  const double correction = rest.high / (2.0 * root);
  const auto [high, low] = exact_sum(root, correction);
  const double bound = (std::abs(rest.low) + rest.error) / root + correction * correction / root +
                       TrackedNumber::unit_roundoff * 2.0 * std::abs(correction);
  return DoubleDouble(high, low, bound);
}

/// The double nearest to the true value, if the bound leaves no doubt which one that is (ties to even are
/// decided only where the value is exact).
[[nodiscard]] inline std::optional<double> rounded(const DoubleDouble& a) {
  constexpr double smallest = 0x1p-900;
  if (a.high == 0.0 && a.error == 0.0) return 0.0;
  if (std::abs(a.high) < smallest) return std::nullopt;
  if (a.error == 0.0) return a.high + a.low;
  const double bound = a.error * (1.0 + 0x1p-20) + std::abs(a.low) * (4.0 * TrackedNumber::unit_roundoff);
  const double above = a.high + (a.low + bound), below = a.high + (a.low - bound);
  return above == below ? std::optional<double>(above) : std::nullopt;
}

}  // namespace ashlar
