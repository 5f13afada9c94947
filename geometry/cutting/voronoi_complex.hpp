// A convex cell divided into the Voronoi cells of points, exactly. Only sources of this layer include this
// file.
//
// Each cell is the whole, cut by the planes half way to the other points, nearest first, until these are more
// than twice as far as the farthest corner left. Planes and corners are the same integers for both neighbours
// of a face, so that cells are put together by what is equal. A Delaunay triangulation would name the
// neighbours before the cuts; it would not spare them, and cells of points near the rim end at the solid's
// own faces.
#pragma once

#include <vector>

#include "geometry/cutting/cell_complex.hpp"

namespace ashlar {

/// @param whole its cell 0 is divided. @param points finite
/// @param mark of faces between cells
/// @throws CutError if two points are one
[[nodiscard]] CellComplex voronoi_complex(const CellComplex& whole, const std::vector<Vector3>& points,
                                          int mark);

}  // namespace ashlar
