// Supports that rotate a block beyond the validity of its elasticity.
#pragma once

#include <cstddef>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"
#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// rad: up to this angle linear elasticity in a fixed frame strains a block by at most angle^2/2 = 0.5 %.
inline constexpr double largest_ordinary_turn = 0.1;

/// Warns of a block with linear elasticity whose frame is fixed by supports (BlockModel::elastic) and whose
/// histories rotate its supported points by more than that before end_time. Rotation of the rest of the block due to
/// a translation of supports does not count. @param index of the block in scene.block. @param block its model
void warn_of_turned_support(const Scene& scene, std::size_t index, const BlockModel& block,
                            Diagnostics& diagnostics);

}  // namespace ashlar
