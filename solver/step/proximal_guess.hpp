// A guess of a step by proximal splitting (ADMM): blocks and contact laws are solved in turn, tied by a spring at every
// contact point, so that one factor serves for all passes. Where many points change their states in a step, it knows most
// of the states after ten to forty solutions, and Newton's method ends the step from there (notes/hard_steps.md).
//
//   blocks  (A + G' H G) x = r + G' (f + H (v - s0))               s = s0 + G x
//   points  f+ - f = H (v+ - y),  f+ = F(v+)                       y = 1.6 s - 0.6 v
//
// with x the change from the first guess, A inertia and stiffness of blocks, r what all forces but contacts lack at the
// first guess, G the rows of the points, s0 their places (gap, slip) there, F the law of each point with all that it has
// (averages over the step, dilation, dashpots, bonds), H its penalty: sqrt(k / w) of its stiffness k and its mobility w.
// S. Boyd et al., Distributed optimization and statistical learning via ADMM, Found. Trends Mach. Learn. 3 (2011) 1.
//
// Coulomb's law has no potential, so that nothing proves convergence: it is a guess, and the best one met is taken.
#pragma once

#include "solver/step/island_tangent.hpp"

namespace ashlar {

/// Takes the guess, with its responses, if it is nearer to balance than the present one: of the largest force on each
/// body the largest part that is left. The factor of the problem's solver is another one then.
/// @param tangent of the problem
/// @return whether it was taken; false also where the system has no factor
[[nodiscard]] bool take_proximal_guess(IslandProblem& problem, IslandTangent& tangent);

}  // namespace ashlar
