// Regions of a plane from the sides that bound them: loops traced, and each hole put into its region. Only
// sources of this layer include this file.
#pragma once

#include <vector>

#include "geometry/cutting/cell_complex.hpp"
#include "geometry/cutting/flat_view.hpp"

namespace ashlar {

/// Connected regions. @param sides of all of them: each vertex has as many that
/// come as go; two meet in common end points only
[[nodiscard]] std::vector<FaceOutline> plane_regions(const CellComplex& complex, const ExactPlane& plane,
                                                     const std::vector<OutlineSide>& sides);

/// Whether a region is one convex loop, points in straight sides allowed.
[[nodiscard]] bool is_convex(const CellComplex& complex, const ExactPlane& plane, const FaceOutline& region);

}  // namespace ashlar
