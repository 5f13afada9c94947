// Every number the solver uses, with unit, default, range and consequence. Those that are `static constexpr` belong to the
// method: nobody sets them, and a change of one is a change of results everywhere.
#pragma once

#include <limits>

#include "geometry/triangle_mesh.hpp"
#include "mechanics/contact/contact_points.hpp"
#include "mechanics/supports/gravity_history.hpp"
#include "solver/linear/linear_solver.hpp"

namespace ashlar {

/// All have the unknown D, the change over the step, conserve momentum and angular momentum
/// (angular_momentum.hpp), and are stable at any step for linear systems. Turning is not linear: where the
/// vibrations of a block are much faster than the step, average-acceleration and generalized-alpha gain
/// energy from 0.01 rad a step on, without bound; dda never does, and loses spin from about 0.05 rad a step
/// on. The first two take the step  D = dt (v + v')/2,  M (v' - v)/dt = F  and differ in where F is taken.
/// Equations in time_scheme.hpp.
enum class Integrator {
  dda,  ///< F at the end of the step: Newmark beta 1/2, gamma 1 (theory.md section 5), dissipative
  average_acceleration,  ///< elastic force at the middle, others averaged: for linear systems Newmark beta
                         ///< 1/4, gamma 1/2, without dissipation; angular momentum stays for large rotations
                         ///< too
  generalized_alpha,  ///< second order, dissipates high frequencies only, by spectral_radius; contact forces
                      ///< are taken at the end of the step as in dda, with exact impulse. Stable
                      ///< for contacts of any stiffness as long as mass_damping * time_step <= 3
};

/// How contacts are searched for, and what may pass.
struct SearchSettings {
  double contact_angle =
      0.17453292519943295;  ///< rad, 0 to pi/4: faces within it of parallel meet as face-face
  /// m, > 0: faces of blocks of order >= 2 that have a neighbour in reach are divided until their certified
  /// chord error is below it; infinity: not at all
  double chord_tolerance = std::numeric_limits<double>::infinity();
  int subdivisions = 2;  ///< 0 to 8, uniform levels for the faces of blocks of order >= 2 to start from
  /// m, > 0, as a share of contact_distance: two blocks may get this far into each other in a step that no
  /// contact was found for; deeper, and the step is cut to the first touch
  static constexpr double passing_share = 0.01;
  /// >= 0, of contact_distance: how far two blocks may have moved relative to each other for what was found of them
  /// to last (notes/lasting_contacts.md); 0: contacts are found in each step
  double lasting_share = 1e-3;
  /// of a step: blocks that would pass earlier than this are kept apart by a contact, not by a shorter step
  static constexpr double smallest_cut = 0.01;
};

/// What a step may end in (step/end_state.hpp).
struct DepthSettings {
  /// m, > 0: how deep a corner or edge may be in another block beyond what contacts know, and in all where
  /// springs only stand for contact that does not give way. 0: the shares below of the smaller block's size
  double allowed_depth = 0.0;
  static constexpr double unknown_depth_share =
      0.01;  ///< beyond what contacts know: such contact is not what was computed
  /// in all: blocks that are so far in each other are not what their springs stand for; from the share above
  /// on a run says so
  static constexpr double allowed_depth_share = 0.1;
  /// steps between audits in which depths of edges in solids that are not convex are exact to passing_share
  /// of the contact distance; in the others they are to the contact distance
  static constexpr int fine_interval = 10;
  /// of its size: a block that has gone so far that its coordinates are rounded to more is lost
  /// (notes/lost_blocks.md)
  static constexpr double lost_share = 1e-6;
};

/// Of an open-close iteration (open_close.hpp). The first five bound work that is then done by the fallback;
/// where the others are exceeded the step is cut.
struct IterationSettings {
  static constexpr int newton_iterations = 60;  ///< newton_patience ends them before
  static constexpr double newton_overshoot =
      0.3;  ///< 0 to 1: work along a change that may be undone by going all its way
  static constexpr int newton_patience = 8;  ///< iterations in which the sum of what is left is not halved
  static constexpr int krylov_iterations =
      30;  ///< of one linear system with friction's coupling to normal forces
  static constexpr int old_factor_iterations =
      10;  ///< of one linear system with a factor of an earlier step: more cost a new one
  static constexpr double old_factor_gain =
      20.0;  ///< solutions that a new factor has to cost for an old one to be kept
  static constexpr double krylov_tolerance = 1e-4;  ///< 0 to 1: larger, and Newton takes more iterations
  static constexpr int fallback_passes = 60;        ///< times the bounds of shear forces are set anew
  static constexpr int minimiser_iterations = 150;  ///< of one pass
  static constexpr double minimiser_share =
      1e-2;  ///< of what is left under Coulomb's law: how well one pass is solved
  static constexpr int line_search_steps = 30;
  static constexpr double line_search_tolerance = 0.05;  ///< of the work at the start of a line
  static constexpr int plain_passes = 8;                 ///< before bounds are extrapolated
  static constexpr double nearly_settled =
      30.0;  ///< multiple of what bodies may lack from which on the last factor will do
  double residual_tolerance =
      1e-10;  ///< of the largest force of a block: when an open-close iteration has settled
  /// of the largest force of a block, at most: what points that only rounding has closed may leave unbalanced
  static constexpr double doubt_share = 1e-7;
  /// >= 0, of contact points in a step after the first: each leaves about a thousandth of what the last left
  /// out
  static constexpr int contact_evaluations = 3;
};

/// Of contact that multipliers hold (notes/augmented_contact.md).
struct MultiplierSettings {
  double penetration_tolerance =
      1e-6;  ///< m, > 0: no contact is deeper, no locked one slips farther in a step
  /// 0 to 1/3, of penetration_tolerance: how far springs beside multipliers give way in a step. Blocks are
  /// moved apart where they are so near to the tolerance that a step could exceed it, to twice this at most
  static constexpr double share = 0.25;
  /// Depth at which multipliers may leave a point, m: a step may add what springs give way by.
  [[nodiscard]] double tolerated_depth() const { return (1.0 - share) * penetration_tolerance; }
  /// 0 to 1, of penetration_tolerance: how exactly multipliers do not give more than they took
  static constexpr double accuracy = 1e-6;

  /// >= 0: points that push at the end of a step keep 1/(1 + this) of their velocity (velocity_contact.hpp).
  /// Larger makes more of rounding, smaller lets forces alternate longer
  double stop_stiffness = 300.0;
  /// before a step, of blocks that are deeper in each other: contacts are others after each
  /// (position_projection.hpp)
  static constexpr int moves_apart = 4;
  static constexpr double apart_residual = 1e-8;  ///< as residual_tolerance, where blocks are moved apart
  int rounds = 40;  ///< balances of a step with other stiffness or multipliers; more: it is cut
};

/// When islands of blocks are put to sleep (step/sleeping_islands.hpp).
struct RestSettings {
  bool sleeps = true;
  static constexpr int window = 30;  ///< steps, > 0: longer is surer and later
  /// >= 0, of contact_distance: how far blocks may have moved in two windows
  static constexpr double way_share = 0.01;
  /// 0 to 1: how much of the way of a window may be left in the next one. Motion that grows or goes on is no rest
  static constexpr double fading = 0.9;
  /// >= 0, of the largest force on a block: what it may lack to be in balance
  static constexpr double unbalanced_share = 1e-4;
};

/// Of a static analysis (statics/static_analysis.hpp).
struct StaticSettings {
  /// as residual_tolerance: tighter, as soft motions make more of a force that is not balanced
  double residual_tolerance = 1e-13;
  double tolerance = 1e-10;  ///< what equilibrium may lack, as a share of a block's largest force
  /// of the largest force of a block: what an iteration may lack whose friction does not settle. The next one goes on
  /// from there, and is no balance unless it lacks `tolerance` at most (notes/when_statics_end.md)
  static constexpr double unsettled_share = 1e-3;
  /// how far a block moves in one iteration at most, as a share of its size: larger takes fewer iterations,
  /// smaller follows contacts better
  double motion = 0.05;
  /// in block sizes: blocks in balance that move less in an iteration stand still, whatever points at the limit of
  /// friction do (notes/when_statics_end.md)
  static constexpr double stillness = 1e-8;
  /// by how much multipliers may change in an iteration that is in balance, as a share of the largest force
  /// of a point: what they do not hold yet, blocks are strained by
  static constexpr double multiplier_tolerance = 1e-6;
  /// in balance, at one load level, for them to come to that; multipliers that do not are left as they are
  static constexpr int multiplier_iterations = 15;
  double travel = 1.0;             ///< in block sizes: farther without coming nearer to balance is moving
  int iterations = 500;            ///< at one load level; more: not converged
  static constexpr int cuts = 60;  ///< of one iteration; more: not converged
  /// of the stiffest block: the inertia that stands in for stiffness where a block has none. Smaller
  /// converges in fewer iterations, larger lets rounding move a free block less
  static constexpr double inertia_share = 1e-9;
  /// the same where supports and ties hold every block without contacts: nothing needs inertia then
  static constexpr double held_inertia_share = 1e-16;
};

/// Settings of a simulation. Those that several parts of it read stand here, the others by who reads them.
struct SimulationSettings {
  Integrator integrator = Integrator::dda;
  /// 0 to 1, of generalized_alpha: what a step leaves of a mode of infinite frequency. 1: no dissipation
  double spectral_radius = 0.8;
  /// 1/s, >= 0: every block is held back by mass_damping M v, its velocity over the ground included: a block
  /// that falls freely reaches g / mass_damping
  double mass_damping = 0.0;
  /// s, >= 0, Rayleigh's beta: the deformation of each block is held back by beta K v, its motion as a whole is not. A
  /// vibration of w rad/s has beta w / 2 of the critical damping
  double stiffness_damping = 0.0;
  double time_step = 1e-3;                     ///< s, > 0: the largest step
  Vector3 gravity = Vector3(0.0, 0.0, -9.81);  ///< m/s^2, unless it has a history
  /// m/s^2, in place of gravity unless empty. It has no potential: its work is that of a load
  GravityHistory gravity_history;
  /// @param time s. @return m/s^2
  [[nodiscard]] Vector3 gravity_at(double time) const {
    return gravity_history.empty() ? gravity : gravity_history.at(time);
  }
  /// At any time, m/s^2.
  [[nodiscard]] double largest_gravity() const {
    return gravity_history.empty() ? gravity.norm() : gravity_history.largest();
  }

  LinearMethod linear_method = LinearMethod::cholesky;

  bool area_springs = true;
  bool curved_surface = true;
  bool augmented = false;  ///< multipliers take over from springs, see augmentation.hpp
  double contact_distance =
      1e-3;  ///< m, > 0: gaps up to this are looked at beyond what this step's motion can close
  static constexpr double tearing_share =
      1e-6;  ///< of contact_distance: joints that open farther have lost their cohesion

  /// What a point without pressure may be open by and still have its cohesion, m.
  [[nodiscard]] double tearing_gap() const { return tearing_share * contact_distance; }
  /// How far two blocks may move before their contacts are found anew, m.
  [[nodiscard]] double lasting_motion() const { return search.lasting_share * contact_distance; }
  /// What rows at the start of a step may leave out of a gap at its end, m; more, and they are taken anew
  /// (notes/contact_at_the_end_of_a_step.md). Springs give way by more than two blocks may meet by unseen.
  [[nodiscard]] double followed_gap() const {
    return augmented ? multipliers.accuracy * multipliers.penetration_tolerance
                     : search.passing_share * contact_distance;
  }

  SearchSettings search;
  DepthSettings depth;
  IterationSettings iteration;
  MultiplierSettings multipliers;
  RestSettings rest;
  StaticSettings statics;

  int max_step_cuts = 12;  ///< halvings of time_step before a run ends as failed
  /// with which an incremental block goes to its initial equilibrium at most; a fifth of them is ample for
  /// small deflections
  static constexpr int settling_steps = 50;
  int threads = 1;  ///< >= 1: for finding contacts; results do not depend on it
};

}  // namespace ashlar
