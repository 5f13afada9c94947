// Is a point inside a closed surface? By the parity of the crossings of a ray, exactly.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// @param solid a closed surface without self-intersections. @param p on it: places next to it in the direction (1, 3, 9)
/// decide, or in (1, 4, 16), ... if that is along an edge or a face
[[nodiscard]] bool is_inside(const TriangleMesh& solid, const Vector3& p);

}  // namespace ashlar
