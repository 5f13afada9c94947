// The surface of a solid as a cut: cells are divided along the planes of its triangles until no triangle passes
// through the inner points of a cell. Then each cell is inside the solid or outside. A plane divides only cells
// crossed by one of its own triangles. Only sources of this layer include this file.
#pragma once

#include <vector>

#include "geometry/cutting/cell_complex.hpp"
#include "geometry/solid/polyhedron.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

struct CellSide {
  int cell;
  bool inside;
};

/// @param cells of the complex, convex. @param surface bounds a solid. @param mark of the new faces.
/// @param most_cells of the complex
/// @return the given cells and the parts divided off them, those of one cell consecutively
/// @throws CutError if there were more cells
[[nodiscard]] std::vector<CellSide> partition_by_surface(CellComplex& complex, const std::vector<int>& cells,
                                                         const TriangleMesh& surface, int mark,
                                                         int most_cells);

/// A cell well around a surface, in a complex. @return the cell
int add_box_around(CellComplex& complex, const TriangleMesh& surface);

}  // namespace ashlar
