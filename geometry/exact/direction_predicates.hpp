// The exact direction of a contact and every question that is asked along it.
//
// A contact direction w is a polynomial in the given coordinates (symbols: d = a - b a difference of two
// points, e an edge vector):
//   difference   w = d                        vertex-vertex                       degree 1
//   cross        w = +-(e1 x e2)              facet normal, edge-edge             degree 2
//   rejection    w = e x (d x e)              the part of d across e: vertex-edge degree 3
// Its length is irrelevant; all questions are about signs of w.d, of w.(d1 x d2) and about ratios that do not
// change when w is scaled by a positive number. w is never rounded before a decision: each rung of the ladder
// evaluates the whole polynomial anew in its own numbers:
//   filter   TrackedNumber, then DoubleDouble (double_double.hpp): floating point with proved error bounds
//   exact    multiple precision, only when both are in doubt
// A construction (the ratio behind a reported coordinate) is rounded once, to the double nearest to the exact
// value: in DoubleDouble when its bound leaves one candidate, else in rational numbers.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <span>

#include "geometry/exact/double_double.hpp"
#include "geometry/exact/number_vector.hpp"
#include "geometry/exact/tracked_number.hpp"

namespace ashlar {

using Vector3 = Eigen::Vector3d;

/// Who decided how often. Deterministic: the same input gives the same counts.
struct DecisionCounts {
  long filter = 0;  ///< signs and roundings settled by floating point with a proved bound
  long exact = 0;   ///< those that needed multiple precision
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

/// (plus - minus) + (plus2 - minus2) of points that outlive it; a null pair is left out, a null minus is the
/// origin.
struct Difference {
  const Vector3* plus = nullptr;
  const Vector3* minus = nullptr;
  const Vector3* plus2 = nullptr;
  const Vector3* minus2 = nullptr;
};

/// Everything of a direction but its points: what a shape keeps of the normals of its facets.
struct DirectionNumbers {
  NumberVector<TrackedNumber> tracked;
  double bound = 0.0;  ///< max e_i + 8 u max |w_i|, rounded up
  NumberVector<DoubleDouble> double_double;
};

/// The sign of w . (x - y) where this follows from the size of its floating value alone. With W the exact w,
/// w its rounded value, e its error, d = fl(x - y), u = 2^-53:
///   |fl(w.d) - W.(x - y)| <= sum |d_i| (e_i + 7 u |w_i|) (1 + 2^-28) <= |d|_1 bound
[[nodiscard]] inline int quick_sign(const DirectionNumbers& w, const Vector3& x, const Vector3& y) {
  const double d0 = x[0] - y[0], d1 = x[1] - y[1], d2 = x[2] - y[2];
  const double value = w.tracked.x.value * d0 + w.tracked.y.value * d1 + w.tracked.z.value * d2;
  const double bound = (std::abs(d0) + std::abs(d1) + std::abs(d2)) * w.bound;
  return value > bound ? 1 : value < -bound ? -1 : unknown_sign;
}

/// See the head of the file. The points it was made from must outlive it.
class ContactDirection {
 public:
  [[nodiscard]] static ContactDirection along(const Difference& d);
  [[nodiscard]] static ContactDirection cross(const Difference& e1, const Difference& e2);
  [[nodiscard]] static ContactDirection rejection(const Difference& d, const Difference& e);
  [[nodiscard]] const DirectionNumbers& numbers() const { return numbers_; }
  /// As a polynomial in the coordinates.
  [[nodiscard]] int degree() const { return kind_ == Kind::difference ? 1 : kind_ == Kind::cross ? 2 : 3; }
  /// e1 x e2 whose numbers are known already.
  [[nodiscard]] static ContactDirection cross(const Difference& e1, const Difference& e2,
                                              const DirectionNumbers& numbers);
  ContactDirection();
  ~ContactDirection();
  ContactDirection(ContactDirection&&) noexcept;
  ContactDirection& operator=(ContactDirection&&) noexcept;
  [[nodiscard]] ContactDirection copy() const;
  /// Turns w into -w.
  void reverse();

  /// w in the numbers of the two floating rungs; the second one is computed on first use.
  [[nodiscard]] const NumberVector<TrackedNumber>& tracked() const { return numbers_.tracked; }
  [[nodiscard]] const NumberVector<DoubleDouble>& double_double() const {
    if (!has_double_double_) compute_double_double();
    return numbers_.double_double;
  }
  /// |w|^2.
  [[nodiscard]] const DoubleDouble& squared_length() const;
  struct ExactVector;
  [[nodiscard]] const ExactVector& exact() const;

 private:
  enum class Kind { difference, cross, rejection };
  ContactDirection(Kind kind, const Difference& first, const Difference& second);
  template <class N>
  [[nodiscard]] NumberVector<N> evaluate() const;
  void set_bound();
  void compute_double_double() const;

  Kind kind_ = Kind::difference;
  bool reversed_ = false;
  mutable bool has_double_double_ = false;
  mutable bool has_squared_length_ = false;
  Difference first_, second_;
  mutable DirectionNumbers numbers_;
  mutable DoubleDouble squared_length_;
  mutable std::unique_ptr<ExactVector> exact_;
};

/// Value of a difference in the numbers of a rung (N::difference of two doubles).
template <class N>
[[nodiscard]] NumberVector<N> evaluate(const Difference& d) {
  const auto subtract = [](const Vector3& a, const Vector3* b) {
    if (b == nullptr) return NumberVector<N>{N(a[0]), N(a[1]), N(a[2])};
    return NumberVector<N>{N::difference(a[0], (*b)[0]), N::difference(a[1], (*b)[1]),
                           N::difference(a[2], (*b)[2])};
  };
  NumberVector<N> first = subtract(*d.plus, d.minus);
  if (d.plus2 == nullptr) return first;
  const NumberVector<N> second = subtract(*d.plus2, d.minus2);
  return {first.x + second.x, first.y + second.y, first.z + second.z};
}

/// Sign of w . d.
[[nodiscard]] int sign_along(const ContactDirection& w, const Difference& d, PredicateLadder& ladder);
/// Sign of w . (x - y).
[[nodiscard]] inline int sign_along(const ContactDirection& w, const Vector3& x, const Vector3& y,
                                    PredicateLadder& ladder) {
  if (ladder.allows(w.degree() + 1)) {
    const int sign = quick_sign(w.numbers(), x, y);
    if (sign != unknown_sign) {
      ++ladder.counts.filter;
      return sign;
    }
  }
  return sign_along(w, Difference{&x, &y}, ladder);
}
/// Sign of (b - a) . ((c - a) x (d - a)): 1 if b is on the side of the plane (a, c, d) its normal points to.
[[nodiscard]] int sign_volume(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d,
                              PredicateLadder& ladder);
/// Sign of w . (d1 x d2).
[[nodiscard]] int sign_triple(const ContactDirection& w, const Difference& d1, const Difference& d2,
                              PredicateLadder& ladder);
/// Sign of w . ((b - a) x (c - a)): 1 if a, b, c turn left when w points at the viewer.
[[nodiscard]] inline int sign_turn(const ContactDirection& w, const Vector3& a, const Vector3& b,
                                   const Vector3& c, PredicateLadder& ladder) {
  return sign_triple(w, Difference{&b, &a}, Difference{&c, &a}, ladder);
}
/// The side of a line in the projection along w: sign(x) = sign_turn(w, a, b, x), with w x (b - a) kept.
class SideOfLine {
 public:
  SideOfLine(const ContactDirection& w, const Vector3& a, const Vector3& b);
  [[nodiscard]] int sign(const Vector3& x, PredicateLadder& ladder) const;

 private:
  const ContactDirection& w_;
  const Vector3 &a_, &b_;
  NumberVector<TrackedNumber> tracked_;
};

/// A coordinate plane onto which a plane across w is projected without losing its orientation.
struct CoordinatePlane {
  int dropped;      ///< the coordinate that is left out
  int orientation;  ///< sign of that component of w, not zero
};
[[nodiscard]] CoordinatePlane coordinate_plane(const ContactDirection& w, PredicateLadder& ladder);
/// sign_turn for points in one plane across w.
[[nodiscard]] int sign_turn(const CoordinatePlane& plane, const Vector3& a, const Vector3& b,
                            const Vector3& c, PredicateLadder& ladder);
/// Sign of (w x d1) . (w x d2): the scalar product of the two in the projection along w.
[[nodiscard]] int sign_projected_dot(const ContactDirection& w, const Difference& d1, const Difference& d2,
                                     PredicateLadder& ladder);
/// True if w x d = 0: the difference vanishes in the projection along w.
[[nodiscard]] bool is_parallel(const ContactDirection& w, const Difference& d, PredicateLadder& ladder);
/// True if w = 0 (parallel edge vectors, or a point on an edge's line).
[[nodiscard]] bool is_zero(const ContactDirection& w, PredicateLadder& ladder);
/// True if (w.d)^2 <= bound^2 |w|^2, or with_length, <= bound^2 |w|^2 |d|^2: d reaches at most the given
/// height along w, or is inclined to the plane across w by at most the angle of the given sine. The bound
/// counts as a coordinate in NumericRange.
[[nodiscard]] bool is_within(const ContactDirection& w, const Difference& d, double bound, bool with_length,
                             PredicateLadder& ladder);
/// Sign of |w1.d1| / |w1| - |w2.d2| / |w2|.
[[nodiscard]] int compare_heights(const ContactDirection& w1, const Difference& d1,
                                  const ContactDirection& w2, const Difference& d2, PredicateLadder& ladder);
/// The mean of the points of one shape minus that of another one, times the product of their numbers.
class MeanDifference {
 public:
  MeanDifference(std::span<const Vector3> a, std::span<const Vector3> b);
  /// Sign of the cosine of (w1, this) minus that of (w2, this).
  [[nodiscard]] int compare_alignment(const ContactDirection& w1, const ContactDirection& w2,
                                      PredicateLadder& ladder) const;

 private:
  template <class N>
  [[nodiscard]] NumberVector<N> evaluate() const;

  std::span<const Vector3> a_, b_;
  NumberVector<TrackedNumber> tracked_;
  NumberVector<DoubleDouble> double_double_;
};
/// True if v = s w with s > 0.
[[nodiscard]] bool same_direction(const ContactDirection& v, const ContactDirection& w,
                                  PredicateLadder& ladder);

// Constructions, each correctly rounded.

/// The height of a difference d along w, and what is constructed with it. Refers to w and the ladder.
class ContactHeight {
 public:
  ContactHeight(const ContactDirection& w, const Difference& d, PredicateLadder& ladder);
  /// (w.d)^2 / |w|^2.
  [[nodiscard]] double squared() const;
  /// |w.d| / |w|.
  [[nodiscard]] double length() const;
  /// w (w.d) / |w|^2.
  [[nodiscard]] Vector3 step() const { return shifted(nullptr, 1); }
  /// Its opposite.
  [[nodiscard]] Vector3 step_back() const { return shifted(nullptr, -1); }
  /// The point above or below x by this height.
  [[nodiscard]] Vector3 above(const Vector3& x) const { return shifted(&x, 1); }
  [[nodiscard]] Vector3 below(const Vector3& x) const { return shifted(&x, -1); }

 private:
  [[nodiscard]] Vector3 shifted(const Vector3* x, int sign) const;

  const ContactDirection& w_;
  Difference d_;
  PredicateLadder& ladder_;
  bool has_ratio_ = false;
  DoubleDouble height_, ratio_;  // w.d, w.d / |w|^2
};

/// w / |w|.
[[nodiscard]] Vector3 unit_vector(const ContactDirection& w, PredicateLadder& ladder);
/// The point of the segment (a, b) that lies over the line (c, d) in the projection along w.
[[nodiscard]] Vector3 crossing_point(const ContactDirection& w, const Vector3& a, const Vector3& b,
                                     const Vector3& c, const Vector3& d, PredicateLadder& ladder);
/// The point of the segment (a, b) in the plane through c across w.
[[nodiscard]] Vector3 plane_point(const ContactDirection& w, const Vector3& a, const Vector3& b,
                                  const Vector3& c, PredicateLadder& ladder);

}  // namespace ashlar
