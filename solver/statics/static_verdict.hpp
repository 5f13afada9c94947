// Evaluation of the iterations of a static analysis: balance, moving blocks and their accelerations
// (static_analysis.hpp).
#pragma once

#include <vector>

#include "solver/statics/static_analysis.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Largest motion of a block of an island, or of all islands, in block sizes.
[[nodiscard]] double largest_motion(const Island& island, const std::vector<BodyStep>& bodies);
[[nodiscard]] double largest_motion(const StepProblem& problem);
/// Displacement of a block since its onset of motion, m.
[[nodiscard]] double displacement_since_onset(const BlockSystem& system, const RunState& state, int block);

/// @name Decisions, which all processes take together
/// @{
/// True if the open-close iteration left no residual in any body (settings.statics.unconverged_share).
[[nodiscard]] bool has_converged(const BlockSystem& system, const StepProblem& problem);
/// Records the residual of each block. @return true if all are within the tolerance
[[nodiscard]] bool note_balance(const BlockSystem& system, RunState& state, const StepProblem& problem);
/// Records the accelerations to be reported for moving blocks. @param problem solved, not accepted
void note_accelerations(const BlockSystem& system, RunState& state, IslandSolvers& solvers,
                        const StepProblem& problem);
/// Notes an iteration, before it is accepted, as one of a cycle if it is nearly in balance. @param calm false: it is none
/// @return true if blocks have come back to where they were some iterations before: they repeat the same motion
/// (notes/when_statics_end.md)
[[nodiscard]] bool repeats_motion(const BlockSystem& system, RunState& state, const StepProblem& problem,
                                  bool calm);
/// Discards recorded accelerations, after an iteration in equilibrium.
void forget_accelerations(RunState& state);
/// True if multipliers have converged: they equal the forces at the end of the iteration.
[[nodiscard]] bool multipliers_repeat(const BlockSystem& system, const StepProblem& problem);
/// True if any block has gone far enough to be listed as moving.
[[nodiscard]] bool has_set_off(const BlockSystem& system, const StaticState& statics);
/// Status of a static analysis that is ended without equilibrium: moving or not converged.
[[nodiscard]] StaticStatus give_up(const BlockSystem& system, StaticState& statics);
/// @}

/// Blocks of this process found to be moving.
struct MovingBlocks {
  std::vector<MovingBlock> first;  ///< from the onset on
  std::vector<MovingBlock>
      later;  ///< set in motion later: reported only if no block of the run moves from the onset on
};
[[nodiscard]] MovingBlocks moving_blocks(const BlockSystem& system, const RunState& state);
/// Blocks of all processes found to be moving, including blocks carried along, by block. Collective.
[[nodiscard]] std::vector<MovingBlock> moving_of_run(const BlockSystem& system, const RunState& state);

}  // namespace ashlar
