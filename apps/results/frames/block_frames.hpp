// Frames of blocks: their surfaces, or their volumes.
#pragma once

#include <vector>

#include "apps/results/frames/drawn_solid.hpp"
#include "apps/results/frames/drawn_surface.hpp"
#include "apps/results/frames/vtu/vtu_writer.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Drawn geometry of each block.
struct DrawnBlocks {
  std::vector<DrawnSurface> surfaces;
  std::vector<DrawnSolid> solids;  ///< empty unless output.solid
};

/// @throws CutError as drawn_solids
[[nodiscard]] DrawnBlocks drawn_blocks(const std::vector<BlockModel>& blocks, const SceneOutput& output);

/// Displacements subtracted from results, m: those at the last reset by a stage.
struct DisplacementOrigin {
  std::vector<Vector3> measures;               ///< by measure (measure_origin), drifts too; empty: as placed
  std::vector<std::vector<Vector3>> surfaces;  ///< by block and point of its DrawnSurface; empty: as placed
  std::vector<std::vector<Vector3>> solids;    ///< by block and point of its DrawnSolid; empty: as placed
};

/// Frame of all present blocks in a state. Point data, as requested: displacement, velocity, stress (xx, yy, zz, xy,
/// yz, xz), principal_stress (largest first). Cell data: block, order (0: fixed or rigid), fixed (0, 1) and face.
/// @param absent by block, or empty
[[nodiscard]] UnstructuredGrid block_frame(const std::vector<BlockModel>& blocks,
                                           const std::vector<BlockState>& states,
                                           const std::vector<DrawnSurface>& surfaces,
                                           const SceneOutput::Fields& fields,
                                           const std::vector<bool>& absent = {},
                                           const DisplacementOrigin& origin = {});

/// The same with volume cells, which have no face.
[[nodiscard]] UnstructuredGrid solid_frame(const std::vector<BlockModel>& blocks,
                                           const std::vector<BlockState>& states,
                                           const std::vector<DrawnSolid>& solids,
                                           const SceneOutput::Fields& fields,
                                           const std::vector<bool>& absent = {},
                                           const DisplacementOrigin& origin = {});

}  // namespace ashlar
