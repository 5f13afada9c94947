// Bolts and props of a run, on one process or several.
//
// All blocks along a bolt are known to each process that has one of them: the others are its neighbours wherever they are.
// Each process with a moving block of a bolt has the bolt in its equations and computes the same forces and states from the
// same numbers; one of them, its owner, books the energies. Other processes have no forces of it: their states of it are
// those of the last tell_bolts(). A process alone owns all bolts.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/bolts/step_bolt.hpp"
#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"

namespace ashlar {

/// True if this process accounts for a bolt: the owner of its lowest block that is not fixed, of the lowest one if all are.
/// The first process has bolts without present blocks. @param bolt index in the run
[[nodiscard]] bool owns_bolt(const BlockSystem& system, std::size_t bolt);

/// True if this process has the present state of a bolt: it owns the bolt, or one of its blocks that is not fixed.
[[nodiscard]] bool knows_bolt(const BlockSystem& system, std::size_t bolt);

/// Bolts of a step: those installed that hold an own moving block.
[[nodiscard]] std::vector<StepBolt> bolts_of_step(const BlockSystem& system, const RunState& state);

/// Lowest block of a bolt that moves. @param bolt of bolts_of_step()
[[nodiscard]] int moving_block(const BlockSystem& system, const StepBolt& bolt);

/// Gives all processes the states of all bolts from their owners. Collective; no effect without others or bolts.
void tell_bolts(const BlockSystem& system, RunState& state);

/// A bolt in the message of its owner.
struct ToldBolt {
  int bolt = -1;
  BoltState state;
};
/// Bolts that this process owns, with their states.
[[nodiscard]] std::vector<ToldBolt> own_bolts(const BlockSystem& system, const RunState& state);
void take_told(std::vector<ToldBolt> told, RunState& state);

}  // namespace ashlar
