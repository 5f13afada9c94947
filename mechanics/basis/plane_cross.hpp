// The cross product of the plane.
#pragma once

#include <Eigen/Core>

namespace ashlar {

/// Twice the signed area of the triangle (0, u, v): positive if v is to the left of u.
[[nodiscard]] inline double cross(const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
  return u.x() * v.y() - u.y() * v.x();
}

}  // namespace ashlar
