// Points of a plane projected along the axis nearest to its normal, so that the orientation as seen from above the
// plane is preserved. All results are exact. Only sources of this layer include this file.
#pragma once

#include "geometry/cutting/exact_plane.hpp"

namespace ashlar {

class FlatView {
 public:
  explicit FlatView(const ExactPlane& plane);

  /// 1 if a, b, c make a left turn, -1 for a right one, 0 if they are in one line.
  [[nodiscard]] int turn(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) const;
  /// -1, 0, 1: by the first coordinate of the view, then by the second. Along a line this is one way.
  [[nodiscard]] int compare(const ExactPoint& a, const ExactPoint& b) const;
  /// The same by the second coordinate alone.
  [[nodiscard]] int compare_heights(const ExactPoint& a, const ExactPoint& b) const;
  /// True if a ray from a point, towards greater first coordinates, meets a segment that does not contain the point.
  /// Where two segments meet at the ray's height, it crosses both or one depending on their other ends.
  [[nodiscard]] bool ray_meets(const ExactPoint& from, const ExactPoint& a, const ExactPoint& b) const;
  /// Coordinates in the view, whose axes go counter-clockwise.
  [[nodiscard]] std::array<Rational, 2> seen(const ExactPoint& point) const;
  /// Twice the signed area of a triangle, in the view.
  [[nodiscard]] Rational doubled_area(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) const;

 private:
  [[nodiscard]] int quick_turn(const Vector3& a, const Vector3& b, const Vector3& c) const;

  int axis_ = 0;   ///< of projection
  int sense_ = 1;  ///< of the normal along it
};

}  // namespace ashlar
