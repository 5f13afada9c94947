// Conditions on the state at the end of a step: it is finite, no block is inverted, and no penetration exceeds the
// allowed depth. Checked before a step is accepted, so that the last valid state is kept.
#pragma once

#include <optional>
#include <vector>

#include "solver/step/run_context.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Fault of a block's state at the end of a problem: not finite or inverted. Empty if all states are valid.
[[nodiscard]] std::optional<StateFault> broken_block(const RunContext& run, const StepProblem& problem);

/// Measures the penetrations of blocks at the end of a problem, which keeps them.
/// @param fine see SimulationSettings::depth::fine_interval. @return the pair that exceeds its allowed depth by most
[[nodiscard]] std::optional<StateFault> audit_depths(const RunContext& run, StepProblem& problem, bool fine);
/// Depths of the present state.
struct PresentDepths {
  std::optional<StateFault> fault;  ///< pair that exceeds its allowed depth by most
  /// True if a pair is deeper than its contacts and earlier audits knew by more than the contact distance. Contacts
  /// detected from then on take the depth into account.
  bool unexpected = false;
};
/// Measures the depths of the present state with the fine audit and records them.
[[nodiscard]] PresentDepths audit_present(const RunContext& run);
/// Records depths at the present time.
void note_depths(const RunContext& run, const std::vector<PairDepth>& depths);

/// Records a step rejected for the state at its end.
void reject(const RunContext& run, double step, const StateFault& fault);
/// Records a step that was cut for another reason.
void reject(const RunContext& run, double step, RejectionReason reason);
/// Records a step whose islands did not converge: the status, or an overflow.
void reject_unsettled(const RunContext& run, double step, IslandStatus status, const StepProblem& problem);

}  // namespace ashlar
