// Volumes in frames with output.solid: evaluation points of each block, and the tetrahedra between them.
#pragma once

#include <vector>

#include "apps/results/frames/vtu/vtu_writer.hpp"
#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Constant during a run.
struct DrawnSolid {
  VtkCellType type = VtkCellType::tetrahedron;  ///< or lagrange_tetrahedron
  std::vector<Vector3> points;                  ///< reference coordinates, m
  std::vector<std::vector<int>> cells;          ///< indices into `points`, in VTK's order
};

/// For each block of the total formulation: the tetrahedra of its undeformed solid (tetrahedra_of), shared by blocks
/// of equal shape. Those of a block that may bend are divided as its drawn surface is, into at most 100 000 in total
/// as long as one part is enough; or they are whole Lagrange tetrahedra of its order.
/// @throws CutError with the block's name if a solid needs too many
[[nodiscard]] std::vector<DrawnSolid> drawn_solids(const std::vector<BlockModel>& blocks, bool lagrange);

}  // namespace ashlar
