// A convex polygon in space with a quantity that is linear on it, such as the pressure of water.
#pragma once

#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

struct LinearPatch {
  std::vector<Vector3> corners;  ///< m, in one plane, convex, at least 3
  double value = 0.0;            ///< at corners[0]
  Vector3 gradient = Vector3::Zero();

  [[nodiscard]] double at(const Vector3& point) const { return value + gradient.dot(point - corners[0]); }
};

}  // namespace ashlar
