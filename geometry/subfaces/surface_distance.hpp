// Lower bound of the distance of two curved surfaces.
#pragma once

#include "geometry/subfaces/placed_surface.hpp"

namespace ashlar {

/// No two points of the true surfaces are nearer than this, m, >= 0: the widest slab across an axis, the line
/// between the middles or a face. 0 may stand for surfaces that are apart. Rounding is allowed for.
[[nodiscard]] double least_distance(const PlacedSurface& a, const PlacedSurface& b);

}  // namespace ashlar
