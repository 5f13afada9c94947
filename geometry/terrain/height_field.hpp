// A surface z(x, y) through scattered points: their Delaunay triangles in plan, by exact predicates.
#pragma once

#include <array>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// The triangles cover the convex hull of the points in plan.
struct HeightField {
  std::vector<Vector3> points;                ///< m, as given, without repeated ones
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from above, in a fixed order
};

/// @param points m. Equal points count once.
/// @throws std::invalid_argument if they are fewer than three or on one line in plan, or if two points of one place in
/// plan have different heights
[[nodiscard]] HeightField height_field(const std::vector<Vector3>& points);

}  // namespace ashlar
