// A cell of any shape parted by a plane, exactly. The work goes with the number of its faces, of those through which
// the plane goes with the squares of their corners at most. Only sources of this layer include this file.
#pragma once

#include <vector>

#include "geometry/cutting/cell_complex.hpp"

namespace ashlar {

/// At least one each; the cell that was parted comes first among those below.
struct CellParts {
  std::vector<int> below, above;
};

/// Faces that the plane goes through are divided along it, for the neighbours too. The plane's own faces are the regions
/// in which it goes through the cell. Parts that meet in an edge or a point only are different ones.
/// @pre the plane parts the cell. @param mark of the faces that come about
CellParts part_cell(CellComplex& complex, int cell, int plane, int mark);

}  // namespace ashlar
