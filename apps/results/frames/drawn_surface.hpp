// Surfaces in frames: evaluation points of each block, and the cells between them.
#pragma once

#include <array>
#include <vector>

#include "apps/results/frames/vtu/vtu_writer.hpp"
#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Constant during a run.
struct DrawnSurface {
  struct Cell {
    VtkCellType type;         ///< triangle, polygon or lagrange_triangle
    int face;                 ///< index into Polyhedron::faces()
    std::vector<int> points;  ///< indices into `points`, counter-clockwise from outside, in VTK's order
  };
  std::vector<Vector3> points;  ///< reference coordinates, m
  std::vector<Cell> cells;
};

/// Triangles of one block that may curve.
struct CurvedTriangles {
  int order = 2;                            ///< of the block
  std::vector<Vector3> points;              ///< m; may include other points than corners
  std::vector<std::array<int, 3>> corners;  ///< indices into `points`
};

/// Straight segments per side of the triangles so that bending appears smooth: from 8 along the diameter of a block
/// of order 2 to 16 for orders from 4. Triangles that are small relative to their block need fewer. With many blocks
/// all get fewer, so that at most 40 000 triangles are drawn as long as one segment is enough.
/// @return (#blocks), each at least 1
[[nodiscard]] std::vector<int> pieces_of_sides(const std::vector<CurvedTriangles>& blocks);

/// True if a block's faces may bend: total formulation, order 2 or more.
[[nodiscard]] bool may_curve(const BlockModel& block);

/// For each block: whole faces if it stays affine; the fixed sub-faces of an incremental one; otherwise the triangles
/// of its mesh, divided by pieces_of_sides, or whole as Lagrange triangles of the block's order. VTK supports them up
/// to order 12, the highest of a block.
[[nodiscard]] std::vector<DrawnSurface> drawn_surfaces(const std::vector<BlockModel>& blocks, bool lagrange);

}  // namespace ashlar
