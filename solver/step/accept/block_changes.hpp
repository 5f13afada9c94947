// Blocks whose model changes between steps: incremental blocks and blocks whose order changes.
#pragma once

#include "solver/step/step_caches.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Losses in a change of order.
struct DroppedByOrder {
  double displacement = 0.0;  ///< root of the mean square over the block, m
  double velocity = 0.0;      ///< likewise, m/s
  double energy = 0.0;        ///< kinetic, elastic and of gravity, J
};

/// Computes the next steps of incremental blocks. @return false if one would no longer be a valid block
[[nodiscard]] bool carry_blocks(const BlockSystem& system, const RunState& state, StepProblem& problem);

/// Starts the next step of an incremental block.
void start_carried_step(BlockSystem& system, RunState& state, StepCaches& caches, int block,
                        CarriedBlock next);

/// Replaces the model of a block by one of the same solid and another order.
void replace_model(BlockSystem& system, RunState& state, StepCaches& caches, int block, BlockModel model);

/// Changes the order of a moving block of the total formulation, see Simulation::change_order.
DroppedByOrder change_order(BlockSystem& system, RunState& state, StepCaches& caches, int block, int order);

}  // namespace ashlar
