// Supports that turn a block whose elasticity does not follow.
#pragma once

#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"
#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// rad: up to here linear elasticity in a frame that stands still strains a block by no more than angle^2/2 =
/// 0.5 %.
inline constexpr double largest_ordinary_turn = 0.1;

/// Warns of each block with linear elasticity whose supports hold its frame (BlockModel::elastic) and whose
/// histories turn its supported points by more than that before end_time. What a translation of supports does
/// to the rest of the block is no turn.
/// @param blocks one per scene.block
void warn_of_turned_supports(const Scene& scene, const std::vector<BlockModel>& blocks,
                             Diagnostics& diagnostics);

}  // namespace ashlar
