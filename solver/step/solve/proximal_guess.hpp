// A guess of a step by proximal splitting (ADMM): blocks and contact laws are solved in turn, coupled by a spring at
// every contact point, so that one factor serves all passes. Where many points change state in a step, it determines
// most of the states after ten to forty solutions, and Newton's method converges from there (notes/hard_steps.md).
//
//   blocks  (A + G' H G) x = r + G' (f + H (v - s0))               s = s0 + G x
//   points  f+ - f = H (v+ - y),  f+ = F(v+)                       y = 1.6 s - 0.6 v
//
// with x the change from the initial guess, A inertia and stiffness of blocks, r the residual without contact forces
// at the initial guess, G the rows of the points, s0 their places (gap, slip) there, F the complete law of each point
// (averages over the step, dilation, dashpots, bonds), H its penalty: sqrt(k / w) of its stiffness k and its mobility
// w.
// S. Boyd et al., Distributed optimization and statistical learning via ADMM, Found. Trends Mach. Learn. 3 (2011) 1.
//
// Coulomb's law has no potential, so that convergence is not proven. The best guess met is returned.
#pragma once

#include "solver/step/island/island_tangent.hpp"

namespace ashlar {

/// Applies the guess and its responses if its residual is smaller than the present one (largest norm on a body over
/// the largest force on it). The factor of the problem's solver changes in any case.
/// @param tangent of the problem
/// @return true if the guess was applied; false also if the system has no factor
[[nodiscard]] bool take_proximal_guess(IslandProblem& problem, IslandTangent& tangent);

}  // namespace ashlar
