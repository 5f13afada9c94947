// Distances of points to segments and triangles, rounded.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Nearest point to p of the segment from a to b, which may be a point.
[[nodiscard]] inline Vector3 closest_on_segment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 along = b - a;
  const double squared = along.squaredNorm();
  return a + (squared > 0.0 ? std::clamp(along.dot(p - a) / squared, 0.0, 1.0) : 0.0) * along;
}

/// m; of a triangle without area the distance to its sides.
[[nodiscard]] inline double distance_to_triangle(const Vector3& p, const std::array<Vector3, 3>& corners) {
  const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  bool over = normal.squaredNorm() > 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3& a = corners[k];
    const Vector3& b = corners[(k + 1) % 3];
    if (normal.cross(b - a).dot(p - a) < 0.0) over = false;
    least = std::min(least, (p - closest_on_segment(p, a, b)).norm());
  }
  return over ? std::min(least, std::abs(normal.normalized().dot(p - corners[0]))) : least;
}

}  // namespace ashlar
