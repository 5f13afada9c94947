// What a static analysis makes of its iterations: whether all is in balance, what is moving and how it sets off
// (static_analysis.hpp).
#pragma once

#include <vector>

#include "solver/statics/static_analysis.hpp"
#include "solver/step/run_context.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Largest motion of a block of an island, or of all islands, in block sizes.
[[nodiscard]] double largest_motion(const Island& island, const std::vector<BodyStep>& bodies);
[[nodiscard]] double largest_motion(const StepProblem& problem);
/// How far a block is from where it set off, m.
[[nodiscard]] double travel(const RunContext& run, int block);

/// Whether no body lacks what its open-close iteration had to leave (settings.statics.unsettled_share).
[[nodiscard]] bool is_settled(const StepProblem& problem);
/// Takes note of what each block lacks of balance. @return whether none lacks anything
[[nodiscard]] bool note_balance(const RunContext& run, const TimeScheme& scheme, const StepProblem& problem);
/// Keeps what is reported of moving blocks. Before the problem is accepted.
void note_accelerations(const RunContext& run, const TimeScheme& scheme, const StepProblem& problem);
/// What moves after an iteration in which nothing was lacking sets off anew.
void forget_accelerations(const RunContext& run);
/// Whether multipliers start an iteration with the forces that it ends with.
[[nodiscard]] bool multipliers_repeat(const RunContext& run, const StepProblem& problem);
/// Whether any block has gone as far as what moves does.
[[nodiscard]] bool has_set_off(const RunContext& run);
/// How a static analysis ends that goes no farther.
[[nodiscard]] StaticStatus give_up(const RunContext& run);
/// Blocks that were found to be moving, and others that move with them.
[[nodiscard]] std::vector<MovingBlock> moving_blocks(const BlockSystem& system, const RunState& state);

}  // namespace ashlar
