// Blocks of a scene that crack ([[crack]]): checks, and the cracks of a simulation.
#pragma once

#include <memory>

#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/model/diagnostics.hpp"
#include "solver/fracture/cracked_blocks.hpp"

namespace ashlar {

/// Reports entries that match no block, blocks that cannot crack (fixed, rigid, tied, bolted, smaller than two parts), and what
/// cracks exclude: searches for an answer, an accuracy, water, boundaries, initial stress, drifts, the incremental formulation,
/// point springs, stages that reset displacements. @param run of a stage of the scene
void check_cracking(const Scene& scene, const Simulation& run, Diagnostics& diagnostics);

/// The cracks of a simulation as built, without any. @param stage its scene, not null
/// @return null if no block cracks. @pre check_cracking() has reported nothing
[[nodiscard]] std::unique_ptr<CrackedBlocks> cracked_blocks(std::shared_ptr<const LoadedScene> stage,
                                                            const Simulation& run);

}  // namespace ashlar
