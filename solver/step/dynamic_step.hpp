// Step control: a step that does not settle is cut in half, one in which blocks would pass through each other is
// cut to their first touch, with the reason recorded; nothing of the state changes until a step is accepted.
#pragma once

#include "solver/step/run_context.hpp"

namespace ashlar {

/// How a step ended.
enum class StepStatus {
  accepted,
  too_many_cuts,  ///< the state is that of the last accepted step; see RunLog::rejections
};

/// Takes one step of at most settings.time_step, and not beyond `end_time`, which is not yet reached. A step that
/// ends there but for rounding is not fitted to it, so that a run that goes on later has had the same steps.
[[nodiscard]] StepStatus take_step(const RunContext& run, double end_time);

}  // namespace ashlar
