// The open-close iteration of an island (theory.md section 8).
//
// The first guess is that all stay, if each then lacks less than a tenth of the largest force on it: blocks at rest need
// one evaluation. Otherwise it is of each body that it falls, coasts or stays, whichever leaves it nearest to residual.
//
// First a semismooth Newton iteration: states, slip directions and elastic frames come from the last guess,
// the linear system, friction's dependence on normal forces included, gives the next. It needs two to five
// systems where states hardly change, and may go round in circles: Coulomb's law is no gradient. A set of
// states that comes back after another one, or iterations that do not halve what all bodies lack
// (notes/friction_iteration.md), hand over to
//
// the fallback: with the bound of each point's shear force held (Tresca's law) the forces are the gradient of
// a convex function of the changes: inertia and elastic energy, penalty springs, friction potentials that are
// quadratic about no slip and linear beyond the bound. Newton with an exact line search converges to its one
// minimum from anywhere. Then the bounds are set anew from the normal forces: a fixed-point iteration that
// contracts for moderate friction and is extrapolated, from its last two changes, where it goes slowly, to
// and fro, or away. Between two passes Newton may finish what has come near enough. A static
// analysis goes on from what is near, settled or not (notes/when_statics_end.md).
//
// What a balance shows goes on from there: joints that fail (joint_failure.hpp), springs beside multipliers that are too
// soft (augmentation.hpp), contact points that have moved.
#pragma once

#include "solver/step/island_equations.hpp"

namespace ashlar {

/// Balances the equations of an island from the changes its bodies have. @param result gets status, counts,
/// responses and laws; the bodies their changes
void iterate_open_close(IslandProblem& problem, IslandResult& result);

}  // namespace ashlar
