// All predicates along a contact direction w (contact_direction.hpp): signs of w.d, of w.(d1 x d2) and of comparisons
// of ratios, each exact.
#pragma once

#include <span>

#include "geometry/exact/contact_direction.hpp"
#include "geometry/exact/predicate_ladder.hpp"

namespace ashlar {

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

}  // namespace ashlar
