// Exact division of a cell of any shape by a plane. The work is linear in the number of its faces, and at most
// quadratic in the number of corners of the divided faces. Only sources of this layer include this file.
#pragma once

#include <vector>

#include "geometry/cutting/cell_complex.hpp"

namespace ashlar {

/// At least one each; the divided cell comes first among those below.
struct CellParts {
  std::vector<int> below, above;
};

/// Divides faces crossed by the plane, for the neighbours too. The new faces in the plane are the regions where it
/// crosses the cell. Parts that meet in an edge or a point only are separate.
/// @pre the plane divides the cell. @param mark of the new faces
CellParts part_cell(CellComplex& complex, int cell, int plane, int mark);

}  // namespace ashlar
