// Models of blocks as the run has changed them, on other ranks than their owners. A ghost is made as the run starts; since
// then its quiet faces may have been released, with a reaction (quiet_release.hpp), and an incremental block has got the
// shape of each of its steps. The loader of models knows none of this.
#pragma once

#include <vector>

#include "solver/step/step_caches.hpp"

namespace ashlar {

/// Changes of a block's model by the run.
struct ModelChange {
  Eigen::MatrixX3d reaction;  ///< released_reaction()
  CarriedShape shape;         ///< of an incremental block
};

[[nodiscard]] ModelChange change_of(const BlockModel& block);
/// Changes the model of a block that is here to that of another rank.
void apply_change(BlockSystem& system, RunState& state, StepCaches& caches, int block, ModelChange change,
                  BlockPartsLibrary& library);

/// Gives ghosts the models that their owners have. Collective; no effect if no block of the run has quiet faces or is
/// incremental.
void update_ghost_models(BlockSystem& system, RunState& state, StepCaches& caches);

/// Gives the first rank, which has the models of all blocks, the shapes of incremental blocks elsewhere. Collective.
/// @param blocks asked for, the same on all ranks; null: all
void send_shapes_to_first(BlockSystem& system, const std::vector<int>* blocks);

}  // namespace ashlar
