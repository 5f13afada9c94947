// Bolts and props of a run that several ranks share.
//
// All blocks along a bolt are known to each rank that has one of them: the others are its ghosts wherever they are. Each
// rank with a moving block of a bolt has the bolt in its equations and computes the same forces and states from the same
// numbers; one of them, its owner, books the energies. Other ranks have no forces of it: their states of it are those of
// the last tell_bolts(). Without ranks the only one owns all bolts.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/bolts/step_bolt.hpp"
#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"

namespace ashlar {

/// True if this rank accounts for a bolt: the owner of its lowest block that is not fixed, of the lowest one if all are.
/// The first rank has bolts without present blocks. @param bolt index in the run
[[nodiscard]] bool owns_bolt(const BlockSystem& system, std::size_t bolt);

/// True if this rank has the present state of a bolt: it owns the bolt, or one of its blocks that is not fixed.
[[nodiscard]] bool knows_bolt(const BlockSystem& system, std::size_t bolt);

/// Bolts of a step: those installed that hold an own moving block.
[[nodiscard]] std::vector<StepBolt> bolts_of_step(const BlockSystem& system, const RunState& state);

/// Lowest block of a bolt that moves. @param bolt of bolts_of_step()
[[nodiscard]] int moving_block(const BlockSystem& system, const StepBolt& bolt);

/// Adds to the ghosts of this rank the blocks that bolts join to own ones. @param ghosts increasing
/// @return increasing, each once
[[nodiscard]] std::vector<int> with_bolted(const BlockSystem& system, std::vector<int> ghosts);

/// Gives all ranks the states of all bolts from their owners. Collective; no effect without ranks or bolts.
void tell_bolts(const BlockSystem& system, RunState& state);

/// States of all bolts on the first rank; those of the other ranks stay as they are. Collective.
void send_bolts_to_first(const BlockSystem& system, RunState& state);

}  // namespace ashlar
