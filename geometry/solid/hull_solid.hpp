// The convex hull of points whose coordinates were rounded.
#pragma once

#include <span>

#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// As Polyhedron(make_convex_hull(points), resolution), with each face a fan of triangles from the first of its
/// corners, and without points that are not corners: rounding must not determine the edges that divide a face.
/// @param points at least 4, m. @param resolution of the coordinates, m, >= 0
/// @throws std::invalid_argument if they are coplanar, fewer than 4 or not finite
/// @throws MeshError if the hull has no volume and is not a solid
[[nodiscard]] Polyhedron make_hull_solid(std::span<const Vector3> points, double resolution);

}  // namespace ashlar
