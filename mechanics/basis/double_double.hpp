// Numbers of 32 decimal digits, the unevaluated sums of two doubles (QD library; Hida, Li, Bailey 2001): eight times
// as fast as fifty_digits.hpp, for what loses few enough digits. Only sources that are compiled without contraction of
// products and sums (-ffp-contract=off) include this file.
#pragma once

#include <qd/dd_real.h>

#include <Eigen/Core>

#include "geometry/exact/fifty_digits.hpp"

namespace ashlar {

using DoubleDouble = dd_real;

/// Bounds the relative error of a sum, product or quotient.
template <class Real>
constexpr double unit_roundoff = 0.0;
/// Four times 2^-104: QD's sums are of its sloppy kind, with an error for each term.
template <>
inline constexpr double unit_roundoff<DoubleDouble> = 0x1p-102;
template <>
inline constexpr double unit_roundoff<FiftyDigits> = 1e-50;

/// To the nearest double.
[[nodiscard]] inline double rounded(const DoubleDouble& value) {
  return value.x[0];
}
[[nodiscard]] inline double rounded(const FiftyDigits& value) {
  return static_cast<double>(value);
}

/// To as many digits as the type has.
template <class Real>
[[nodiscard]] Real converted(const FiftyDigits& value);
template <>
[[nodiscard]] inline FiftyDigits converted<FiftyDigits>(const FiftyDigits& value) {
  return value;
}
template <>
[[nodiscard]] inline DoubleDouble converted<DoubleDouble>(const FiftyDigits& value) {
  const auto high = static_cast<double>(value);
  return {high, static_cast<double>(FiftyDigits(value - high))};
}
template <class Real>
[[nodiscard]] Real converted(const DoubleDouble& value);
template <>
[[nodiscard]] inline DoubleDouble converted<DoubleDouble>(const DoubleDouble& value) {
  return value;
}
template <>
[[nodiscard]] inline FiftyDigits converted<FiftyDigits>(const DoubleDouble& value) {
  return FiftyDigits(value.x[0]) + FiftyDigits(value.x[1]);
}

}  // namespace ashlar

namespace Eigen {
template <>
struct NumTraits<dd_real> : GenericNumTraits<double> {
  using Real = dd_real;
  using NonInteger = dd_real;
  using Nested = dd_real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 20,
    MulCost = 20
  };
};
}  // namespace Eigen
