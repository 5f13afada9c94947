// Iterations of a static analysis (static_analysis.hpp).
#pragma once

#include <vector>

#include "solver/statics/static_analysis.hpp"
#include "solver/step/run_context.hpp"

namespace ashlar {

/// Takes one iteration towards equilibrium under the loads of `end_time`, or starts a load level.
/// @param far in block sizes, > 0: blocks that are certain to go so far are moving (certain_motion.hpp)
/// @throws std::logic_error if a block is incremental
[[nodiscard]] StaticStatus static_step(const RunContext& run, double end_time, double far);

}  // namespace ashlar
