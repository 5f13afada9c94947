// Lower bound of the distance of two curved surfaces.
#pragma once

#include "geometry/subfaces/placed_surface.hpp"

namespace ashlar {

/// No two points of the true surfaces are nearer than this, m, >= 0: the widest slab across an axis, the line
/// between the middles or a face; where a surface has many cells (PlacedSurface::has_many_cells) the least such slab of
/// cells that are near each other, at most half of the smaller surface's size beyond the distance of the boxes. 0 may
/// stand for surfaces that are apart. Rounding is allowed for.
[[nodiscard]] double least_distance(const PlacedSurface& a, const PlacedSurface& b);

}  // namespace ashlar
