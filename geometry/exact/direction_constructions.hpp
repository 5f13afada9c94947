// Heights, unit vectors and points along a contact direction, each coordinate rounded once: to the double nearest to
// the exact value, in DoubleDouble when its bound leaves one candidate, else in rational numbers.
#pragma once

#include "geometry/exact/contact_direction.hpp"
#include "geometry/exact/predicate_ladder.hpp"

namespace ashlar {

/// The height of a difference d along w, and constructions with it. Refers to w and the ladder.
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
