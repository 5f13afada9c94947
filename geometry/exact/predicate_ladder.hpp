// Selection of floating-point rungs for exact predicates on coordinates by the degree of their polynomials, and
// counts of the deciding rungs.
#pragma once

#include <algorithm>

namespace ashlar {

/// Number of decisions by rung. Deterministic: the same input gives the same counts.
struct DecisionCounts {
  long filter = 0;  ///< signs and roundings settled by floating point with a proved bound
  long exact = 0;   ///< signs and roundings that needed multiple precision
};

/// Exponents of the coordinates of a shape: all are multiples of 2^lowest_bit and below 2^highest_bit in
/// magnitude (lowest_bit > highest_bit: all zero). Decides whether floating point can under- or overflow.
///
/// Let l and h be the two exponents, k the degree of a polynomial in the coordinates, u = 2^-53. Rounding to
/// 53 bits leaves a multiple of 2^m one, so every value on the way to a quantity of degree i <= k (its own
/// intermediate results, low parts and dropped parts) is zero or at least 2^(i l). A bound of its error is
/// zero or at least u times such a value. With k l >= -960:
///   - a value or a product of two values is zero or at least 2^-960, so both parts of an error-free product
///     are exact (they are multiples of 2^-960) and u times a value is at least 2^-1013, no underflow;
///   - a value times a bound is zero or at least 2^((i + j) l) u >= 2^-1013, no underflow;
///   - a product of two bounds can underflow in the last step only (before it, k <= 10: >= 2^(-864 - 106));
///     less than 2^15 operations lose less than 2^-1059 by it. To a bound above 2^-1029 sign_of() adds 2^-30
///     of it, which is more; a smaller bound is far below every value that is not zero.
/// With k h <= 900 a sum of 2^90 terms times Dekker's splitter stays below 2^1018. What a polynomial needs
/// follows from its own degree: a coordinate with bits far below the size of the shape (the 6e-17 that stands
/// for a cosine of zero) closes the floating rungs to the polynomials of high degree only.
struct NumericRange {
  static constexpr int highest_degree = 10;  ///< higher ones are left to the exact rung

  int lowest_bit = 2000;
  int highest_bit = -2000;

  void include(double coordinate);
  void include(const NumericRange& other);
  /// The highest degree, at most highest_degree, of polynomials that neither under- nor overflow.
  [[nodiscard]] int degree() const {
    if (highest_bit < lowest_bit) return highest_degree;
    const auto within = [](int budget, int exponent) {
      return exponent * highest_degree <= budget ? highest_degree : budget / exponent;
    };
    return std::min(within(960, -lowest_bit), within(900, highest_bit));
  }
  /// All polynomials, and the quotients of constructions (double_double.hpp).
  [[nodiscard]] bool safe() const { return degree() == highest_degree; }
};

/// The ladder's state for one query: which polynomials its floating rungs may be asked, and the counts.
struct PredicateLadder {
  bool floating = true;  ///< all up to the highest degree, and constructions
  DecisionCounts counts;
  int degree = 0;  ///< if not floating: those up to this degree

  /// Opens the floating rungs as far as a range allows.
  void open(const NumericRange& range) {
    degree = range.degree();
    floating = range.safe();
  }
  [[nodiscard]] bool allows(int of_degree) const {
    return of_degree <= (floating ? NumericRange::highest_degree : degree);
  }
};

}  // namespace ashlar
