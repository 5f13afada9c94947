// Start of motion from the static state of the whole scene: a static analysis under gravity and the loads at time 0
// precedes the first step. It provides the positions of blocks and the memory of contacts (bonds, slip of springs,
// forces of multipliers), so that all forces are in balance in the first step. Its energies, work and rejected
// iterations are not part of the motion.
//
// Unsupported blocks, free or in contact with each other only, have no static state: they are held as placed until
// the motion begins.
#pragma once

#include <functional>

#include "solver/statics/static_analysis.hpp"
#include "solver/step/run_context.hpp"

namespace ashlar {

/// Starts a run whose contacts have not been detected yet. With other processes collective.
/// @param may_continue called before each iteration: false ends the analysis; the same on all processes
/// @return status of the static analysis, balancing if it was ended; unless it is equilibrium all blocks are as
/// placed
[[nodiscard]] StaticStatus start_from_statics(const RunContext& run,
                                              const std::function<bool()>& may_continue);

/// Energy of the springs of all ties in the present state, J: records have those of contacts only.
[[nodiscard]] double energy_of_ties(const BlockSystem& system, RunState& state, StepContacts& contacts);

}  // namespace ashlar
