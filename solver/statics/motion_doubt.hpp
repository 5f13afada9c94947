// A static analysis ends as moving where blocks have gone far. Blocks also go far where they sink into soft ones, or sway on
// them until they lean: the accelerations recorded at the onset tell, and the contacts of the last iteration.
#pragma once

#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"

namespace ashlar {

/// Reasons to doubt that blocks move that have gone far: they may yield to compliance.
enum class MotionDoubt {
  none,
  /// contacts resist, and the fastest has less than 1e-3 of what their forces would give it, which is compliance
  no_acceleration,
  opposed,  ///< contacts that press resist the accelerations, and the iterations are used up
};

/// Of an analysis that ended as moving, by its accelerations and the contacts of its last iteration. Collective.
[[nodiscard]] MotionDoubt doubt_of_motion(const BlockSystem& system, const RunState& state);

}  // namespace ashlar
