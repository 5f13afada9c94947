// Tied joints: the pairs of blocks bonded by a simulation, and joints without effect.
#pragma once

#include <vector>

#include "apps/scene/assemble/block_summary.hpp"
#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/joint_table.hpp"
#include "apps/scene/model/scene.hpp"
#include "solver/state/block_system.hpp"

namespace ashlar {

/// Every pair of blocks whose joint is tied. @param blocks of the scene
[[nodiscard]] std::vector<TieRequest> ties_of(const Scene& scene, const JointTable& table,
                                              const std::vector<BlockSummary>& blocks);

/// Reports a [[joint]] that ties nothing as an error at its key, and one undone by later ones as a warning. @param
/// system with the ties. With several processes collective: all report the same
void check_ties(const Scene& scene, const JointTable& table, const BlockSystem& system,
                Diagnostics& diagnostics);

}  // namespace ashlar
