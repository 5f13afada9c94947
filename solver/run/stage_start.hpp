// A stage of construction: the run goes on with other blocks present, other supports, loads, laws and settings,
// from where another simulation of the same blocks has ended.
//
// What is taken over is where blocks are, how they move and what their contacts remember: bonds, slip of
// springs, forces of multipliers. So what has not changed is in balance in the first step of the stage as it
// was in the last one before. Loads keep the factors that Simulation::set_load_factor gave them. Steps are counted on; the clock, the ledger and the work of contacts begin anew.
#pragma once

#include <vector>

#include "solver/step/snapshot.hpp"

namespace ashlar {

/// To be called before the first step. Blocks that were absent start as this simulation has placed them.
/// @param end of the stage before. @param was_absent in it, by block
/// @throws std::invalid_argument if it is one of other blocks, or of other orders
void start_stage(const RunContext& run, const SimulationSnapshot& end, const std::vector<bool>& was_absent);

}  // namespace ashlar
