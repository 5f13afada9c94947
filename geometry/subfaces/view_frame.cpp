#include "geometry/subfaces/view_frame.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace ashlar {

ViewFrame::ViewFrame(const Vector3& origin_, const Vector3& direction)
    : origin(origin_), w(direction.normalized()) {
  // The axis least along w gives the best conditioned frame; ties go to the first.
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(w[k]) < std::abs(w[axis])) axis = k;
  }
  e1 = Vector3::Unit(axis).cross(w).normalized();
  e2 = w.cross(e1);
}

Eigen::Vector2d ViewFrame::project(const Vector3& point) const {
  const Vector3 r = point - origin;
  return {e1.dot(r), e2.dot(r)};
}

}  // namespace ashlar
