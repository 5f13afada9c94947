// All parameters of the solver, with unit, default, range and effect. Those that are `static constexpr` are constants
// of the method: a change of one changes all results.
#pragma once

#include <limits>

#include "geometry/triangle_mesh.hpp"
#include "mechanics/contact/contact_points.hpp"
#include "mechanics/supports/gravity_history.hpp"
#include "solver/linear/linear_solver.hpp"

namespace ashlar {

/// All have the unknown D, the change over the step, conserve momentum and angular momentum (angular_momentum.hpp),
/// and are stable at any step for linear systems. Rotation is not linear: if the vibrations of a block are much
/// faster than the step, average-acceleration and generalized-alpha gain energy without bound from 0.01 rad a step
/// on. dda never does, and loses spin from about 0.05 rad a step on. The first two take the step  D = dt (v + v')/2,
/// M (v' - v)/dt = F  and differ in where F is evaluated. Equations in time_scheme.hpp.
enum class Integrator {
  dda,  ///< F at the end of the step: Newmark beta 1/2, gamma 1 (theory.md section 5), dissipative
  average_acceleration,  ///< elastic force at the middle, others averaged: for linear systems Newmark beta
                         ///< 1/4, gamma 1/2, without dissipation; conserves angular momentum for large
                         ///< rotations too
  generalized_alpha,  ///< second order, dissipates high frequencies only, by spectral_radius; contact forces
                      ///< are evaluated at the end of the step as in dda, with exact impulse. Stable for
                      ///< contacts of any stiffness if mass_damping * time_step <= 3
};

/// Contact search and continuous collision check.
struct SearchSettings {
  double contact_angle =
      0.17453292519943295;  ///< rad, 0 to pi/4: faces within this angle of parallel have face-face contact
  /// m, > 0: faces of blocks of order >= 2 with a neighbour in reach are divided until their certified chord error is
  /// below it; infinity: no division
  double chord_tolerance = std::numeric_limits<double>::infinity();
  int subdivisions = 2;  ///< 0 to 8, initial uniform levels of division for the faces of blocks of order >= 2
  /// m, > 0, as a share of contact_distance: allowed penetration of two blocks without contact in a step. A step that
  /// exceeds it is cut to the first touch
  static constexpr double passing_share = 0.01;
  /// >= 0, of contact_distance: relative motion of two blocks up to which cached contacts are valid
  /// (notes/contact_cache.md); 0: contacts are detected in each step
  double cache_share = 1e-3;
  /// of a step: blocks that would pass earlier than this are stopped by a contact, not by a shorter step
  static constexpr double smallest_cut = 0.01;
};

/// Limits on the state at the end of a step (step/detect/end_state.hpp).
struct DepthSettings {
  /// m, > 0: allowed depth of a corner or edge in another block beyond the depth of contacts, and in total for rigid
  /// contact. 0: the shares below of the smaller block's size
  double allowed_depth = 0.0;
  static constexpr double unknown_depth_share =
      0.01;  ///< beyond the depth of contacts: a deeper contact was not computed correctly
  /// in total: springs do not represent the contact of blocks that penetrate so deep; a run warns from the share
  /// above on
  static constexpr double allowed_depth_share = 0.1;
  /// steps between audits in which depths of edges in solids that are not convex are exact to passing_share of the
  /// contact distance; in the other steps they are exact to the contact distance
  static constexpr int fine_interval = 10;
  /// of its size: a block whose coordinates are rounded to more is outside the range of double precision
  /// (notes/lost_blocks.md)
  static constexpr double lost_share = 1e-6;
};

/// Settings of an open-close iteration (open_close.hpp). Beyond the first five limits the fallback takes over; beyond
/// the others the step is cut.
struct IterationSettings {
  static constexpr int newton_iterations = 60;  ///< usually ended earlier by newton_patience
  static constexpr double newton_overshoot =
      0.3;  ///< 0 to 1: work along a full step that may be negative, relative to that at its start
  static constexpr int newton_patience = 8;  ///< iterations without halving the total residual
  static constexpr int krylov_iterations =
      30;  ///< of one linear system including the coupling of friction to normal forces
  static constexpr int old_factor_iterations =
      10;  ///< of one linear system with a factor of an earlier step: if it needs more, a new one is made
  static constexpr double old_factor_gain =
      20.0;  ///< cost of a new factor, in solutions, from which on an old one is kept
  static constexpr double krylov_tolerance = 1e-4;  ///< 0 to 1: larger values increase the number of Newton
                                                    ///< iterations
  static constexpr int fallback_passes = 60;        ///< updates of the bounds of shear forces
  static constexpr int minimiser_iterations = 150;  ///< of one pass
  static constexpr double minimiser_share =
      1e-2;  ///< accuracy of one pass relative to the residual under Coulomb's law
  static constexpr int line_search_steps = 30;
  static constexpr double line_search_tolerance = 0.05;  ///< of the work at the start of a line
  static constexpr int plain_passes = 8;                 ///< before bounds are extrapolated
  static constexpr double nearly_converged =
      30.0;  ///< multiple of the tolerance below which the last factor is used again
  double residual_tolerance =
      1e-10;  ///< convergence of an open-close iteration, relative to the largest force on a block
  /// residual tolerated from contacts closed only within rounding error, at most, relative to the largest force on a
  /// block
  static constexpr double doubt_share = 1e-7;
  /// >= 0, of contact points in a step after the first: each reduces the error of the gaps to about a thousandth
  static constexpr int contact_evaluations = 3;
};

/// Settings of contact by multipliers (notes/augmented_contact.md).
struct MultiplierSettings {
  double penetration_tolerance =
      1e-6;  ///< m, > 0: largest penetration, and largest slip of a locked contact in a step
  /// 0 to 1/3, of penetration_tolerance: deformation of springs beside multipliers in a step. Blocks whose depth
  /// could exceed the tolerance in a step are separated, to at most twice this
  static constexpr double share = 0.25;
  /// Depth at which multipliers may leave a point, m: a step may add the deformation of springs.
  [[nodiscard]] double tolerated_depth() const { return (1.0 - share) * penetration_tolerance; }
  /// 0 to 1, of penetration_tolerance: accuracy of the condition that multipliers release no more than they have
  /// taken
  static constexpr double accuracy = 1e-6;

  /// >= 0: points under compression at the end of a step keep 1/(1 + this) of their velocity (velocity_contact.hpp).
  /// Larger values amplify rounding errors, smaller ones let forces alternate longer
  double stop_stiffness = 300.0;
  /// times per step that blocks are separated: contacts change after each (position_projection.hpp)
  static constexpr int moves_apart = 4;
  static constexpr double apart_residual = 1e-8;  ///< as residual_tolerance, for the separation of blocks
  int rounds = 40;  ///< balances of a step with other stiffness or multipliers; if more are needed it is cut
};

/// Conditions for putting islands of blocks to sleep (step/detect/sleeping_islands.hpp).
struct RestSettings {
  bool sleeps = true;
  static constexpr int window = 30;  ///< steps, > 0: longer windows are safer and slower
  /// >= 0, of contact_distance: largest motion of a block in two windows
  static constexpr double path_share = 0.01;
  /// 0 to 1: largest ratio of the path in a window to that in the last one. Growing or steady motion is not at rest
  static constexpr double fading = 0.9;
  /// >= 0, of the largest force on a block: its largest residual at rest
  static constexpr double unbalanced_share = 1e-4;
};

/// Settings of a static analysis (statics/static_analysis.hpp).
struct StaticSettings {
  /// as residual_tolerance: tighter, as soft modes amplify residual forces
  double residual_tolerance = 1e-13;
  double tolerance = 1e-10;  ///< residual of equilibrium, relative to a block's largest force
  /// of the largest force of a block: largest residual of an iteration whose friction does not converge. The next one
  /// continues from it, and is in balance only if its residual is within `tolerance` (notes/when_statics_end.md)
  static constexpr double unconverged_share = 1e-3;
  /// largest motion of a block in one iteration, as a share of its size: larger values need fewer iterations, smaller
  /// ones follow contacts more accurately
  double motion = 0.05;
  /// in block sizes: balanced blocks that move less in an iteration are at rest, even if points at the friction limit
  /// change state (notes/when_statics_end.md)
  static constexpr double stillness = 1e-8;
  /// largest change of converged multipliers in an iteration in balance, as a share of the largest force of a point:
  /// the change is transmitted by springs and strains the blocks
  static constexpr double multiplier_tolerance = 1e-6;
  /// balanced iterations at one load level for multipliers to converge; then they are left as they are
  static constexpr int multiplier_iterations = 15;
  double displacement_limit = 1.0;  ///< in block sizes: blocks that go farther without halving their residual
                                    ///< are moving
  int iterations = 500;             ///< at one load level; more: not converged
  static constexpr int cuts = 60;   ///< of one iteration; more: not converged
  /// iterations at one load level after which rigid blocks tell whether they move: smaller values ask where the elastic
  /// iteration would soon end, larger ones iterate longer where blocks move
  static constexpr int rigid_question_after = 16;
  /// of the stiffest block: inertia that replaces stiffness where a block has none. Smaller values converge in fewer
  /// iterations, larger ones reduce the motion of a free block by rounding errors
  static constexpr double inertia_share = 1e-9;
  /// the same if supports and ties hold every block without contacts: inertia is not needed then
  static constexpr double held_inertia_share = 1e-16;
};

/// Settings of a simulation. Those read by several parts are direct members, the others are grouped by reader.
struct SimulationSettings {
  Integrator integrator = Integrator::dda;
  /// 0 to 1, of generalized_alpha: amplification of a mode of infinite frequency in a step. 1: no dissipation
  double spectral_radius = 0.8;
  /// 1/s, >= 0: the force mass_damping M v resists the motion of every block, its velocity over the ground included:
  /// a block in free fall reaches g / mass_damping
  double mass_damping = 0.0;
  /// s, >= 0, Rayleigh's beta: the force beta K v resists the deformation of each block, but not its rigid motion. A
  /// vibration of w rad/s has beta w / 2 of the critical damping
  double stiffness_damping = 0.0;
  double time_step = 1e-3;                     ///< s, > 0: the largest step
  Vector3 gravity = Vector3(0.0, 0.0, -9.81);  ///< m/s^2, unless it has a history
  /// m/s^2, replaces gravity unless empty. It has no potential: its work is booked as that of a load
  GravityHistory gravity_history;
  /// @param time s. @return m/s^2
  [[nodiscard]] Vector3 gravity_at(double time) const {
    return gravity_history.empty() ? gravity : gravity_history.at(time);
  }
  /// Largest value over time, m/s^2.
  [[nodiscard]] double largest_gravity() const {
    return gravity_history.empty() ? gravity.norm() : gravity_history.largest();
  }

  LinearMethod linear_method = LinearMethod::cholesky;

  bool area_springs = true;
  bool curved_surface = true;
  bool augmented = false;  ///< multipliers replace springs, see augmentation.hpp
  double contact_distance =
      1e-3;  ///< m, > 0: search distance of contacts in addition to the motion of the step
  static constexpr double tearing_share =
      1e-6;  ///< of contact_distance: joints that open farther lose their cohesion

  /// rad, > 0: turn of a deformable block in a step of average_acceleration and generalized_alpha, at most. Larger values
  /// gain energy (notes/turn_limit.md): with this one less than 1 % in 30 rad
  static constexpr double largest_turn = 0.03;

  /// Largest opening of a point without pressure that preserves its cohesion, m.
  [[nodiscard]] double tearing_gap() const { return tearing_share * contact_distance; }
  /// Relative motion of two blocks up to which cached contacts are valid, m.
  [[nodiscard]] double cached_motion() const { return search.cache_share * contact_distance; }
  /// Largest error of the gap at the end of a step due to rows at its start, m; beyond it the rows are updated
  /// (notes/contact_at_the_end_of_a_step.md). With springs it is the allowed undetected penetration, which is less
  /// than their deformation.
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
  /// largest number of steps of an incremental block to its initial equilibrium; a fifth of them suffices for small
  /// deflections
  static constexpr int settling_steps = 50;
  int threads = 1;  ///< >= 1: for finding contacts; results do not depend on it
};

}  // namespace ashlar
