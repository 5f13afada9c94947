// What a step may end in: states that are finite, blocks that have not turned inside out, none deeper in
// another one than is allowed. Asked before a step is accepted, so that the last good state is kept.
#pragma once

#include <optional>
#include <vector>

#include "solver/step/run_context.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Whether a block's state at the end of a problem is none that it can have: not finite or inside out.
[[nodiscard]] std::optional<StateFault> broken_block(const RunContext& run, const StepProblem& problem);

/// Measures how deep blocks would be in each other at the end of a problem, which keeps the depths.
/// @param fine see SimulationSettings::depth::fine_interval. @return the pair that is too deep by most
[[nodiscard]] std::optional<StateFault> audit_depths(const RunContext& run, StepProblem& problem, bool fine);
/// Depths of the present state.
struct PresentDepths {
  std::optional<StateFault> fault;  ///< the pair that is too deep by most
  /// a pair is deeper than its contacts and earlier audits knew by more than the contact distance: contacts that are
  /// detected from now on know of it
  bool unexpected = false;
};
/// Measures the depths of the present state, finely, and notes them.
[[nodiscard]] PresentDepths audit_present(const RunContext& run);
/// Takes note of depths at the present time.
void note_depths(const RunContext& run, const std::vector<PairDepth>& depths);

/// Takes note of a state that a step would have ended in.
void reject(const RunContext& run, double step, const StateFault& fault);
/// Takes note of a step that was cut for another reason.
void reject(const RunContext& run, double step, RejectionReason reason);
/// Takes note of a step whose islands found no balance: why, or that their numbers have overflowed.
void reject_unsettled(const RunContext& run, double step, IslandStatus status, const StepProblem& problem);

}  // namespace ashlar
