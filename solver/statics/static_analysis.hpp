// Static analysis: equilibrium under the loads of a time, contacts included (theory.md section 5).
//
// An iteration is the dda step of blocks let go from rest: contacts are found, and
//     F_external - F_elastic(D) + F_contact(D) - rho m D = 0,   m = 2/dt^2,
// is solved by the open-close iteration; then all blocks move by D and lose their velocity. The first m is
// that of the scene's time step; it falls tenfold with each iteration that settles and rises where an
// iteration does not settle or a block would move too far at once, so that the iteration ends as a Newton
// iteration of the static equations and begins as a motion that contacts can follow. rho m D is what
// equilibrium still lacks, and what is left of the equations where friction did not settle
// (settings.statics.unsettled_share).
//
// Slip is that of the load level, from where blocks were when its loads were put on, whatever happened in
// between: what slid, lifted off or tore while inertia carried part of the load is no part of the answer.
// Bonds hold until the level has been in balance once (notes/static_friction.md).
//
// Equilibrium: m has fallen to its least, rho m D is below settings.statics.tolerance of the largest force on
// every block and no contact has changed its state or no block has moved, twice in a row, as the first time
// soft motions may still be on their way; multipliers have to repeat themselves too. Moving: a block has
// travelled settings.statics.travel of its size and what it lacks was not halved on the way, or a tenth of
// that when no iterations or cuts are left, or it lacks the same forces in iteration after iteration and would meet
// nothing before it has gone so far (straight_way.hpp); listed as moving is what has then gone a thousandth of it. m D is
// the acceleration of the blocks from rest, whatever m, but for what contacts and blocks give way by, which
// is taken out where no joint is asked to (rigid_onset.cpp). What is reported is that of the iteration, since
// the last one in which nothing was lacking or a joint lost its strength, in which all blocks together lacked
// least, none in which contacts began to slide or stopped: contacts have taken up there what they bear. Of
// rigid blocks, it is how they set off: iterations count as long as none has gone farther than
// settings.contact_distance, and blocks that are set in motion later are not listed.
//
// Loads that change follow their histories in levels of settings.time_step, each brought to equilibrium;
// constant ones are taken at the end time at once.
#pragma once

#include "solver/state/static_state.hpp"

namespace ashlar {

/// How an iteration of a static analysis ended.
enum class StaticStatus {
  balancing,      ///< go on
  equilibrium,    ///< of the loads at the end time
  moving,         ///< no equilibrium near: Simulation::moving_blocks tells which
  not_converged,  ///< too many iterations or cuts: see Simulation::rejections; stiffer or fewer joints may
                  ///< help
};

/// A block that no equilibrium holds, let go from rest.
struct MovingBlock {
  int block;
  Vector3 acceleration;          ///< of the centroid, m/s^2
  Vector3 angular_acceleration;  ///< rad/s^2, of the mean rotation
};

}  // namespace ashlar
