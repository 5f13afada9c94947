// First rung of the predicate ladder: a double that carries a bound of its own error.
//
// With u = 2^-53 and rounding to nearest, fl(x op y) = (x op y)(1 + d), |d| <= u, as long as nothing under-
// or overflows; hence |fl(r) - r| <= u |fl(r)| (1 + 2u). Every operation adds that bound to the bounds
// inherited from its operands. The bounds themselves are rounded: each of them is low by at most a few u, so
// a polynomial of less than 2^15 operations underestimates its error by less than 2^-30 of it, which
// sign_of() adds back. Under- and overflow are excluded beforehand by NumericRange (predicate_ladder.hpp);
// rounding to nearest is granted by NearestRounding (rounding_mode.hpp).
#pragma once

#include <cmath>

namespace ashlar {

/// Sign of a quantity whose error bound does not allow one.
inline constexpr int unknown_sign = 2;

/// |true - value| <= error * (1 + 2^-30).
struct TrackedNumber {
  static constexpr double unit_roundoff = 0x1p-53;
  double value = 0.0;
  double error = 0.0;

  TrackedNumber() = default;
  explicit TrackedNumber(double exact) : value(exact) {}
  TrackedNumber(double approximate, double bound) : value(approximate), error(bound) {}

  /// a - b for two exact doubles.
  static TrackedNumber difference(double a, double b) {
    const double result = a - b;
    return {result, unit_roundoff * std::abs(result)};
  }
  friend TrackedNumber operator+(const TrackedNumber& a, const TrackedNumber& b) {
    const double result = a.value + b.value;
    return {result, a.error + b.error + unit_roundoff * std::abs(result)};
  }
  friend TrackedNumber operator-(const TrackedNumber& a, const TrackedNumber& b) {
    const double result = a.value - b.value;
    return {result, a.error + b.error + unit_roundoff * std::abs(result)};
  }
  friend TrackedNumber operator*(const TrackedNumber& a, const TrackedNumber& b) {
    const double result = a.value * b.value;
    return {result, std::abs(a.value) * b.error + (std::abs(b.value) + b.error) * a.error +
                        unit_roundoff * std::abs(result)};
  }
};

/// -1, 0, 1, or unknown_sign.
[[nodiscard]] inline int sign_of(const TrackedNumber& a) {
  const double bound = a.error * (1.0 + 0x1p-30);
  if (a.value > bound) return 1;
  if (a.value < -bound) return -1;
  return bound == 0.0 ? 0 : unknown_sign;
}

}  // namespace ashlar
