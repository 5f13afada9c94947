// Motion that starts from the static state of the whole scene: a static analysis under gravity and the loads
// at time 0 comes before the first step. What it leaves is where blocks are and what contacts remember:
// bonds, slip of springs, forces of multipliers, so that the first step finds all forces in balance. What it
// did to get there, energies, work and rejected iterations, is no part of the motion.
//
// Blocks that nothing holds, in the air or in contact with each other only, have no static state: they stay
// as placed, as if they were fixed, until the motion begins.
#pragma once

#include <functional>

#include "solver/statics/static_analysis.hpp"
#include "solver/step/run_context.hpp"

namespace ashlar {

/// To be called before the first step. @param goes_on asked before each iteration: if not, it ends there
/// @return how the static analysis ended, balancing if it was ended; unless that is equilibrium all is as placed
[[nodiscard]] StaticStatus start_from_statics(const RunContext& run, const std::function<bool()>& goes_on);

}  // namespace ashlar
