// Numbers of 32 decimal digits as unevaluated sums of two doubles (QD library; Hida, Li, Bailey 2001): eight times as
// fast as fifty_digits.hpp, if the loss of digits is small enough. Only sources compiled without contraction of
// products and sums (-ffp-contract=off) may include this file.
#pragma once

#include <qd/dd_real.h>

#include <Eigen/Core>
#include <type_traits>

#include "geometry/exact/fifty_digits.hpp"

namespace ashlar {

using ExtendedDouble = dd_real;

/// Bounds the relative error of a sum, product or quotient.
template <class Real>
constexpr double unit_roundoff = 0.0;
/// Four times 2^-104: QD's sums are of its sloppy kind, with an error for each term.
template <>
inline constexpr double unit_roundoff<ExtendedDouble> = 0x1p-102;
template <>
inline constexpr double unit_roundoff<FiftyDigits> = 1e-50;

/// To the nearest double.
[[nodiscard]] inline double rounded(const ExtendedDouble& value) {
  return value.x[0];
}
[[nodiscard]] inline double rounded(const FiftyDigits& value) {
  return static_cast<double>(value);
}

/// Converts to another type of the same or fewer digits.
template <class Real, class From>
[[nodiscard]] Real converted(const From& value) {
  if constexpr (std::is_same_v<Real, From>) {
    return value;
  } else {
    const double high = rounded(value);
    return {high, rounded(From(value - high))};
  }
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
