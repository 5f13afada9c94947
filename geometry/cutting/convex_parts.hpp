// Division of a cell into convex parts. Only sources of this layer include this file.
#pragma once

#include <vector>

#include "geometry/cutting/cell_complex.hpp"

namespace ashlar {

/// Divides a cell by planes of its own faces, each through a reflex edge: for r of these there are at most (r^2 + r)
/// / 2 + 1 parts. A plane divides only the cell with the edge. @param mark of the new faces
/// @return the cells, marked as convex
/// @throws CutError if the complex would have more than most_cells
[[nodiscard]] std::vector<int> convex_parts(CellComplex& complex, int cell, int mark, int most_cells);

}  // namespace ashlar
