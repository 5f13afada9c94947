// Bolts and props of a run that several ranks share: what only ranks need (step/island/bolts_of_run.hpp has the others).
#pragma once

#include <vector>

#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"

namespace ashlar {

/// Adds to the ghosts of this rank the blocks that bolts join to own ones. @param ghosts increasing
/// @return increasing, each once
[[nodiscard]] std::vector<int> with_bolted(const BlockSystem& system, std::vector<int> ghosts);

/// States of all bolts on the first rank; those of the other ranks stay as they are. Collective.
void send_bolts_to_first(const BlockSystem& system, RunState& state);

}  // namespace ashlar
