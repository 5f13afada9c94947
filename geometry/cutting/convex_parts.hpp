// A cell parted until all of its parts are convex. Only sources of this layer include this file.
#pragma once

#include <vector>

#include "geometry/cutting/cell_complex.hpp"

namespace ashlar {

/// Parts a cell by planes of its own faces, each through a reflex edge: with r of these there are at most
/// (r^2 + r) / 2 + 1 parts. A plane parts only the cell with the edge. @param mark of the faces that come about
/// @return the cells, which know that they are convex
/// @throws CutError if the complex had more than most_cells
[[nodiscard]] std::vector<int> convex_parts(CellComplex& complex, int cell, int mark, int most_cells);

}  // namespace ashlar
