// The convex hull of points whose coordinates were rounded.
#pragma once

#include <span>

#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// As Polyhedron(make_convex_hull(points), resolution), with each face a fan of triangles from the first of
/// its corners, and points that are no corners dropped: which edges divide a face is not for rounding to say.
/// @param points at least 4, m. @param resolution m, >= 0: what coordinates are known to
/// @throws std::invalid_argument if they are coplanar, fewer than 4 or not finite
/// @throws MeshError if the hull, for want of volume, is no solid
[[nodiscard]] Polyhedron make_hull_solid(std::span<const Vector3> points, double resolution);

}  // namespace ashlar
