// Step control: a step that does not converge is halved; one in which blocks would pass through each other is cut to
// their first touch. The reason is recorded. One in which a joint with restitution closes ends before the touch. The state changes only when a step is accepted.
#pragma once

#include "solver/step/run_context.hpp"

namespace ashlar {

/// Outcome of a step.
enum class StepStatus {
  accepted,
  too_many_cuts,  ///< the state is that of the last accepted step; see RunLog::rejections
};

/// Takes one step of at most settings.time_step that does not pass `end_time`, which is not yet reached. A step that
/// ends at `end_time` but for rounding is not snapped to it, so that a run continued later has had the same steps.
[[nodiscard]] StepStatus take_step(const RunContext& run, double end_time);

}  // namespace ashlar
