// Blocks cut by a horizontal level.
#pragma once

#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// True if some corners of a block lie on or below a level and some on or above it. @param up unit vector
[[nodiscard]] bool reaches_level(const std::vector<Vector3>& corners, const Vector3& up, double height);

/// The point on the line through the centroid along `up` at a height, m.
[[nodiscard]] Vector3 point_at_level(const Vector3& centroid, const Vector3& up, double height);

}  // namespace ashlar
