// What a run takes over from a step that was accepted: motion, energies, memory of contacts.
#pragma once

#include "solver/step/run_context.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Moves all blocks to the end of a solved problem and books its energies. Takes from the problem what it keeps.
void accept(const RunContext& run, const TimeScheme& scheme, StepProblem& problem);

}  // namespace ashlar
