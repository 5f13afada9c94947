// A convex cell divided into the Voronoi cells of points, exactly. Only sources of this layer include this
// file.
//
// Each cell is the whole, cut by the planes midway to the other points, nearest first, until these are more than
// twice as far as the farthest remaining corner. Planes and corners are the same integers for both neighbours of a
// face, so that cells are assembled by equality. A Delaunay triangulation would give the neighbours before the cuts,
// but not avoid them, and cells of points near the boundary end at the solid's own faces.
#pragma once

#include <vector>

#include "geometry/cutting/cell_complex.hpp"

namespace ashlar {

/// @param whole its cell 0 is divided. @param points finite
/// @param mark of faces between cells
/// @throws CutError if two points coincide
[[nodiscard]] CellComplex voronoi_complex(const CellComplex& whole, const std::vector<Vector3>& points,
                                          int mark);

}  // namespace ashlar
