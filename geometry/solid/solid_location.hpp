// Is a point inside a closed surface? By the parity of the crossings of a ray, exactly.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// @param solid a closed surface without self-intersections. @param p not on it.
[[nodiscard]] bool is_inside(const TriangleMesh& solid, const Vector3& p);

}  // namespace ashlar
