// The open-close iteration of an island (theory.md section 8).
//
// The initial guess is that all blocks stay at rest, if the residual of each is then below a tenth of the largest
// force on it: blocks at rest need one evaluation. Otherwise the predictor with the smallest residual is used, for
// all bodies or for each of them (predictor.hpp).
//
// First a semismooth Newton iteration: states, slip directions and elastic frames of the last guess enter the linear
// system, including the dependence of friction on normal forces. Its solution is the next guess. It needs two to five
// systems where states hardly change. It may cycle, since Coulomb's law has no potential. A repeated set of states,
// or iterations that do not halve the total residual (notes/friction_iteration.md), lead to
//
// the fallback: with the bound of each point's shear force held (Tresca's law) the forces are the gradient of a
// convex function of the changes: inertia and elastic energy, penalty springs, friction potentials that are quadratic
// about no slip and linear beyond the bound. Newton with an exact line search converges to its unique minimum from
// any guess. Then the bounds are updated from the normal forces. This fixed-point iteration contracts for moderate
// friction. It is extrapolated from its last two changes where it converges slowly, alternates or diverges. Between
// two passes Newton may finish once the guess is close enough. A static analysis continues from a near guess,
// converged or not (notes/when_statics_end.md).
//
// The iteration continues from a balance if joints fail (joint_failure.hpp), springs beside multipliers are too soft
// (augmentation.hpp) or contact points have moved.
#pragma once

#include "solver/step/island/island_equations.hpp"

namespace ashlar {

/// Balances the equations of an island, starting from the changes of its bodies. @param result status, counts,
/// responses and laws are written; the bodies get their changes
void iterate_open_close(IslandProblem& problem, IslandResult& result);

}  // namespace ashlar
