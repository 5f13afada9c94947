// Updates a run with an accepted step: motion, energies and contact memory.
#pragma once

#include "solver/step/step_caches.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Moves all blocks to the end of a solved problem and books its energies.
/// @param system models of incremental blocks are replaced, blocks that come to rest are held
/// @param problem is used up: its bodies refer to the start of the step
void accept(BlockSystem& system, RunState& state, StepCaches& caches, StepProblem&& problem);

}  // namespace ashlar
