// Random points with uniform distribution inside a convex solid.
//
// The solid is divided into tetrahedra from one of its corners. Each point selects one of them by volume and a place
// in it, so that the time does not depend on the share of its bounding box that the solid fills.
#pragma once

#include <random>
#include <vector>

#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// @param solid convex. @param count >= 0
/// @return points in the convex hull of the corners, but for the rounding of their coordinates
[[nodiscard]] std::vector<Vector3> random_points(const Polyhedron& solid, int count, std::mt19937_64& random);

}  // namespace ashlar
