// The verdict of limit analysis on a static analysis that has ended (limit_analysis.hpp). An analysis without a
// result stands or moves. One in equilibrium moves if the equilibrium needs forces that only wedging could have
// caused.
//
// An analysis without a result that no motion from rest decides is decided by the load path (load_path.hpp): rigid blocks
// on the springs of their joints, loaded slowly from no forces, come to rest or not.
//
// Motion that contacts or compliance oppose is confirmed by a motion of rigid blocks, or it is none: a block that sinks into
// a soft one, or sways on it, goes as far as one that slides (notes/when_statics_end.md).
//
// It applies if rigid blocks are decisive: joints keep their strength when they slide, loads are constant, no support
// moves, no bolt is installed, and neither stress of the ground nor an earlier equilibrium under other loads may have left
// forces. If loads have changed, it states for an analysis without a result if they are beyond what any forces balance, or at
// that limit.
#pragma once

#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"
#include "solver/statics/static_analysis.hpp"

namespace ashlar {

/// Records the motion found by limit analysis for moving_blocks(), or the forces of rigid blocks at rest and their places.
/// @param status of the analysis. @return moving, or the same status; not_converged for a motion that rigid blocks do not
/// have
[[nodiscard]] StaticStatus rigid_verdict(const BlockSystem& system, RunState& state, double end_time,
                                         StaticStatus status);

/// True if iterations have recorded accelerations of blocks of this process.
[[nodiscard]] bool has_accelerations(const StaticState& statics);

/// Verdict on an analysis that goes on, with all blocks on this process: moving if no forces within the strengths balance the loads where the
/// level began, and rigid blocks followed from there go far (followed_collapse.hpp). Joints with friction only, no bolts.
/// @return moving, with the motion recorded, or balancing: undecided
[[nodiscard]] StaticStatus rigid_collapse(const BlockSystem& system, RunState& state, double end_time);

}  // namespace ashlar
