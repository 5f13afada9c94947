// Conditions on the state at the end of a step: it is finite, no block is inverted, and no penetration exceeds the
// allowed depth. Checked before a step is accepted, so that the last valid state is kept.
#pragma once

#include <optional>
#include <vector>

#include "solver/step/step_caches.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Fault of a block's state at the end of a problem: not finite or inverted. Empty if all states are valid.
[[nodiscard]] std::optional<StateFault> broken_block(const BlockSystem& system, const RunState& state,
                                                     const StepProblem& problem);

/// Measures the penetrations of blocks at the end of a problem, which keeps them. @param state its log counts the time
/// @param fine see SimulationSettings::depth::fine_interval. @return the pair that exceeds its allowed depth by most
[[nodiscard]] std::optional<StateFault> audit_depths(const BlockSystem& system, RunState& state,
                                                     StepCaches& caches, StepProblem& problem, bool fine);
/// Depths of the present state.
struct PresentDepths {
  std::optional<StateFault> fault;  ///< pair that exceeds its allowed depth by most
  /// True if a pair is deeper than its contacts and earlier audits knew by more than the contact distance. Contacts
  /// detected from then on take the depth into account.
  bool unexpected = false;
};
/// Measures the depths of the present state with the fine audit and records them.
[[nodiscard]] PresentDepths audit_present(const BlockSystem& system, RunState& state, StepCaches& caches);
/// Records depths at the present time.
void note_depths(const BlockSystem& system, RunState& state, const std::vector<PairDepth>& depths);

/// Cause of a rejection.
struct RejectionCause {
  RejectionReason reason;
  std::optional<StateFault> fault;  ///< of the state at the end of the step, if that is the cause
};
/// Cause of a step whose islands did not converge: the status, or an overflow.
[[nodiscard]] RejectionCause cause_of_failure(const BlockSystem& system, const RunState& state,
                                              const StepProblem& problem, IslandStatus status);
/// Records a rejected step. @param step its length, s
void reject(RunState& state, double step, RejectionReason reason);

}  // namespace ashlar
