// Convexity of a solid within the rounding error of its coordinates, as for a rotated copy of a convex solid.
#pragma once

#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// A concave edge that is at most this many units in the last place of the mesh's greatest coordinate below
/// its convex counterpart counts as rounding. Each of the four corners of two triangles is off by at most
/// 2 units in each coordinate after a rotation and a translation in floating point, two of them towards and
/// two away from the others: 2 * 2 * sqrt(3) < 7. Such meshes are marked in every report.
inline constexpr int rounding_dent_units = 8;

/// True if every concave edge is no deeper than rounding_dent_units: decided exactly.
[[nodiscard]] bool is_convex_but_for_rounding(const Polyhedron& solid);

}  // namespace ashlar
