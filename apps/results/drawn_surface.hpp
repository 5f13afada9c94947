// The surfaces that frames show: where each block is evaluated, and the cells between these points.
#pragma once

#include <array>
#include <vector>

#include "apps/results/vtu_writer.hpp"
#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Constant through a run.
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
  std::vector<Vector3> points;              ///< m; others than corners do no harm
  std::vector<std::array<int, 3>> corners;  ///< indices into `points`
};

/// Straight pieces into which each side of the triangles is divided so that bending does not show: from 8
/// along the diameter of a block of order 2 to 16 for orders from 4. Triangles that are small against their
/// block need fewer; with many blocks all get fewer, so that no more than 40 000 triangles are drawn, as long
/// as one piece is enough.
/// @return (#blocks), each at least 1
[[nodiscard]] std::vector<int> pieces_of_sides(const std::vector<CurvedTriangles>& blocks);

/// Whether a block's faces may bend: of the total formulation, of order 2 or more.
[[nodiscard]] bool may_curve(const BlockModel& block);

/// Of each block: whole faces if it stays affine; the fixed sub-faces of an incremental one; else the
/// triangles of its mesh, divided by pieces_of_sides, or whole as Lagrange triangles of the block's order.
/// VTK takes them up to order 12, the highest there is.
[[nodiscard]] std::vector<DrawnSurface> drawn_surfaces(const std::vector<BlockModel>& blocks, bool lagrange);

}  // namespace ashlar
