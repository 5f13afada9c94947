// Updates a run with an accepted step: motion, energies and contact memory.
#pragma once

#include "solver/step/run_context.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Moves all blocks to the end of a solved problem and books its energies. Moves the data it keeps out of the
/// problem.
void accept(const RunContext& run, const TimeScheme& scheme, StepProblem& problem);

}  // namespace ashlar
