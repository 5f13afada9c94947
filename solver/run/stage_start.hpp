// A stage of construction: the run continues with other blocks present, other supports, loads, laws and settings,
// from the end of another simulation of the same blocks.
//
// Positions and velocities of blocks and the memory of contacts are kept: bonds, slip of springs, forces of
// multipliers. So unchanged parts are in balance in the first step of the stage as they were at the end of the last
// one. Loads keep the factors set by Simulation::set_load_factor. The count of steps continues; the clock, the ledger
// and the work of contacts are reset.
#pragma once

#include <vector>

#include "solver/step/snapshot.hpp"

namespace ashlar {

/// Starts a run whose contacts have not been detected yet. Blocks that were absent start where it has placed them.
/// @param end of the stage before. @param was_absent in it, by block
/// @throws std::invalid_argument if it has other blocks or other orders, or if a block that was absent is tied to one that
/// has moved
void start_stage(BlockSystem& system, RunState& state, StepCaches& caches, const SimulationSnapshot& end,
                 const std::vector<bool>& was_absent);

}  // namespace ashlar
