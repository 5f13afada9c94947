// Velocity-level contact: augmented contact ends a step with impulses that stop approaching points.
//
// A step that holds a point, D = 0, ends with v' = -v, or nearly (time_scheme.hpp). The velocity then changes sign in
// each further step, and the contact force alternates by 2 m v/dt. Springs damp this by their compliance (fastest at
// k dt^2/2m = 8). Multipliers do not, as their springs are stiffened as required. So contact is enforced for
// velocities too, by separate impulses (Bruels, Acary and Cardona, Computer Methods in Applied Mechanics and
// Engineering 281, 2014):
//
//   M (v'' - v') = dt G^T j,   j = -c G u,   u = v'' - (beta/gamma - 1/2) dt a'
// c = stop_stiffness m/dt N/(N + N0)        m: effective inertia of a point, N: its normal force
//
// u vanishes for a point pressed by a constant force: generalized-alpha keeps a velocity there, and without the shift
// would miss the force that the steady impulse transmits, and its friction. The other integrators have u = v''.
//
// G: normal velocities of points under compression by multipliers, shear velocities too of locked ones, all velocities
// of bonds and ties. Springs of joints without a bond have finite forces and no impulse. N0 moves a point in a step by the allowed deformation of springs: points with less force have little
// weight, so that rounding errors do not decide which points are stopped. Impulses may be tensile, as reversed
// velocities point outwards, but not by more than the compressive impulse of the point in the step. A point that
// would need more is released, with no force at all in this step. Impulses have no friction; the bounds of shear
// forces in the next steps account for it (deferred friction), up or down, as long as the point stays in contact.
// Impulses dissipate energy of u, never generate it: impacts are plastic where blocks meet, and deformable blocks
// rebound by their elasticity. The energy loss of v is booked as numerical dissipation. A set of free blocks keeps
// its angular momentum: the energy for that spin is taken from the dissipation of impulses and contacts
// (contact_accounts.hpp).
#pragma once

#include <vector>

#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Effect of a pair's impulses at the end of a step.
struct StoppedPair {
  /// Forces of its points in their frames, impulse over step, N; empty: none
  std::vector<Eigen::Vector3d> forces;
  double work = 0.0;  ///< on both blocks, J
};

/// Stops approaching points at the end of a step whose blocks have been moved. Changes velocities and books their
/// energy loss. With several processes collective. @return by pair of the problem
[[nodiscard]] std::vector<StoppedPair> stop_at_contacts(const BlockSystem& system, RunState& state,
                                                        IslandSolvers& solvers, const StepProblem& problem);

}  // namespace ashlar
