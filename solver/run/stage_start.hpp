// A stage of construction: the run continues with other blocks present, other supports, loads, laws and settings,
// from the end of another simulation of the same blocks.
//
// Positions and velocities of blocks and the memory of contacts are kept: bonds, slip of springs, forces of
// multipliers. So unchanged parts are in balance in the first step of the stage as they were at the end of the last
// one. Loads keep the factors set by Simulation::set_load_factor. The count of steps continues; the clock, the ledger
// and the work of contacts are reset.
//
// On several processes a stage has other owners than the last one: each process takes what its blocks and neighbours need from the
// snapshot of the whole run, as after a checkpoint, with the pairs of its own blocks alone (shared/shared_snapshot.hpp).
#pragma once

#include <vector>

#include "solver/step/accept/snapshot.hpp"
#include "solver/step/run_context.hpp"

namespace ashlar {

/// Starts a run whose contacts have not been detected yet. Blocks that were absent start where it has placed them. With
/// several processes collective.
/// @param end of the stage before; of the whole run, with the pairs that this process may need (add_pairs_of_rank) or all
/// @param was_absent in it, by block
/// @throws std::invalid_argument if it has other blocks or other orders, or if a block that was absent is tied to one that
/// has moved; on all processes the same
void start_stage(const RunContext& run, const SimulationSnapshot& end, const std::vector<bool>& was_absent);

}  // namespace ashlar
