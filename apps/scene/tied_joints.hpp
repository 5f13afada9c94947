// Joints that are tied: the pairs of blocks that a simulation glues together, and joints that ask for it in vain.
#pragma once

#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/joint_table.hpp"
#include "apps/scene/scene.hpp"
#include "solver/state/block_system.hpp"

namespace ashlar {

/// Every pair of blocks whose joint is tied. @param blocks of the scene
[[nodiscard]] std::vector<TieRequest> ties_of(const Scene& scene, const JointTable& table,
                                              const std::vector<BlockModel>& blocks);

/// A [[joint]] that ties nothing is an error at its key, one that later ones undo a warning. @param system with the ties
void check_ties(const Scene& scene, const JointTable& table, const BlockSystem& system,
                Diagnostics& diagnostics);

}  // namespace ashlar
