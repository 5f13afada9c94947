// Regions of a plane from the sides that bound them: traces loops, and assigns each hole to its region. Only sources
// of this layer include this file.
#pragma once

#include <vector>

#include "geometry/cutting/cell_complex.hpp"
#include "geometry/cutting/flat_view.hpp"

namespace ashlar {

/// Connected regions. @param sides of all of them: each vertex has as many incoming as outgoing ones; two meet in
/// common end points only
[[nodiscard]] std::vector<FaceOutline> plane_regions(const CellComplex& complex, const ExactPlane& plane,
                                                     const std::vector<OutlineSide>& sides);

/// True if a region is one convex loop, possibly with points in straight sides.
[[nodiscard]] bool is_convex(const CellComplex& complex, const ExactPlane& plane, const FaceOutline& region);

}  // namespace ashlar
