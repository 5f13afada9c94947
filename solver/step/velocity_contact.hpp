// Where contact is augmented, a step ends with impulses that stop what pushes.
//
// A step that holds a point where it is, D = 0, ends with v' = -v, or nearly (time_scheme.hpp): the velocity
// turns round in each further step, and the contact force alternates by 2 m v/dt. Springs damp that as far as
// they give way (fastest at k dt^2/2m = 8), multipliers, whose springs are as stiff as it takes, do not. So
// contact is enforced for velocities too, by impulses of their own (Bruels, Acary and Cardona, Computer
// Methods in Applied Mechanics and Engineering 281, 2014):
//
//   M (v'' - v') = dt G^T j,   j = -c G u,   u = v'' - (beta/gamma - 1/2) dt a'
//   c = stop_stiffness m/dt N/(N + N0)        m: inertia that a point feels, N: its normal force
//
// u is what stands still under a constant force that pushes: generalized-alpha keeps a velocity there, and
// would lack the force that a steady impulse bears, and its friction. The others have u = v''.
//
// G: normal velocities of points that push, shear velocities too of those that are locked, and all of bonds
// and ties. N0 moves a point in a step by what springs may give way by: what has less force counts for
// little, so that rounding does not say what is stopped. Impulses may pull, as velocities that have turned
// round point away, but by no more than a point has pushed in the step: where more would be needed the point
// is let go, with no force at all in this step. Friction has no part in them; the bounds of shear forces in
// the next steps make up for that, up or down, as long as the point stays in contact. They take energy of
// u, never less than nothing: impacts are plastic where blocks meet, and what can deform bounces by its
// elasticity. What v loses is booked as numerical dissipation. A set of free blocks keeps its angular
// momentum: the spin for that comes from what impulses and contacts have taken (contact_accounts.hpp).
#pragma once

#include <vector>

#include "solver/step/run_context.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// What a pair's impulses at the end of a step do.
struct StoppedPair {
  /// Of its points in their frames, impulse over step, N; empty: none
  std::vector<Eigen::Vector3d> forces;
  double work = 0.0;  ///< on both blocks, J
};

/// Stops what pushes at the end of a step whose blocks have been moved: changes velocities, books what they lose.
/// @return by pair of the problem
[[nodiscard]] std::vector<StoppedPair> stop_at_contacts(const RunContext& run, const TimeScheme& scheme,
                                                        const StepProblem& problem);

/// Whether nothing but its own blocks acts on an island beside gravity and loads.
[[nodiscard]] bool is_free(const BlockSystem& system, const Island& island,
                           const std::vector<ContactPair>& pairs);

}  // namespace ashlar
