// Static analysis: equilibrium under the loads of a time, contacts included (theory.md section 5).
//
// An iteration is the dda step of blocks released from rest: contacts are detected, and
//     F_external - F_elastic(D) + F_contact(D) - rho m D = 0,   m = 2/dt^2,
// is solved by the open-close iteration. Then all blocks move by D and lose their velocity. The first m is that of
// the scene's time step. It decreases tenfold with each iteration that converges, and increases if an iteration does
// not converge or a block would move too far at once. So the analysis begins as a motion that contacts can follow and
// ends as a Newton iteration of the static equations. rho m D, plus the residual of the equations if friction did not
// converge (settings.statics.unconverged_share), is the residual of equilibrium.
//
// Slip counts from the positions at the start of the load level. Sliding, uplift and failure in between, while
// inertia carried a part of the load, have no effect on the result. Bonds hold until the level has been in balance
// once (notes/static_friction.md).
//
// 1. Equilibrium: m has reached its minimum, and rho m D is below settings.statics.tolerance of the largest force on
// every block. No contact has changed its state or no block has moved. Both hold twice in a row, as soft motions may
// not have ended the first time. Multipliers have converged too.
// 2. Moving: a block has moved settings.statics.displacement_limit of its size without halving its residual, or a
// tenth of that when no iterations or cuts are left. An early stop applies to a block with constant residual that
// would meet nothing on its way so far (certain_motion.hpp). All blocks that have moved a thousandth of
// settings.statics.displacement_limit are listed as moving.
// 3. Accelerations: m D is the acceleration of the blocks from rest for any m, except for the compliance of contacts
// and blocks, which is removed unless the stiffness of a joint was given (rigid_onset.cpp). Reported is the iteration
// of smallest total residual since the last equilibrium or failure of a joint, excluding iterations in which contacts
// began or stopped sliding: in the others contact forces are fully developed. For rigid blocks it is the onset:
// iterations count until a block has gone farther than settings.contact_distance. Blocks set in motion later are not
// listed.
//
// Loads that vary follow their histories in levels of settings.time_step, each brought to equilibrium. Constant loads
// are applied at the end time at once.
#pragma once

#include "solver/state/static_state.hpp"

namespace ashlar {

/// Outcome of an iteration of a static analysis.
enum class StaticStatus {
  balancing,      ///< continue
  equilibrium,    ///< of the loads at the end time
  moving,         ///< no equilibrium near: Simulation::moving_blocks tells which
  not_converged,  ///< too many iterations or cuts: see Simulation::rejections; stiffer or fewer joints may
                  ///< help
};

/// A block without equilibrium, released from rest.
struct MovingBlock {
  int block;
  Vector3 acceleration;          ///< of the centroid, m/s^2
  Vector3 angular_acceleration;  ///< rad/s^2, of the mean rotation
};

}  // namespace ashlar
