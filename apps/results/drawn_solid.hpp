// The volumes that frames show with output.solid: where each block is evaluated, and the tetrahedra between these
// points.
#pragma once

#include <vector>

#include "apps/results/vtu_writer.hpp"
#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Constant through a run.
struct DrawnSolid {
  VtkCellType type = VtkCellType::tetrahedron;  ///< or lagrange_tetrahedron
  std::vector<Vector3> points;                  ///< reference coordinates, m
  std::vector<std::vector<int>> cells;          ///< indices into `points`, in VTK's order
};

/// Of each block of the total formulation: the tetrahedra of its undeformed solid (tetrahedra_of), once for blocks of
/// equal shape. Those of a block that may bend are divided as its drawn surface is, but all together into no more
/// than 100 000, as long as one piece is enough; or they are whole Lagrange tetrahedra of its order.
/// @throws CutError with the block's name if a solid takes too many
[[nodiscard]] std::vector<DrawnSolid> drawn_solids(const std::vector<BlockModel>& blocks, bool lagrange);

}  // namespace ashlar
