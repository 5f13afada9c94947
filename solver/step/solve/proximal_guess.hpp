// A guess of a step by operator splitting (linear/splitting.hpp), with one factor for all passes. Where many points change
// state in a step, it determines most of the states after ten to forty solutions, and Newton's method converges from
// there (notes/hard_steps.md).
//
// x is the change from the initial guess, A inertia and stiffness of blocks, b the residual without contact forces at
// the initial guess, s0 the places (gap, slip) there, f+ the complete law of each point (averages over the step,
// dilation, dashpots, bonds), H = sqrt(k / w) of its stiffness k and its mobility w.
#pragma once

#include "solver/step/island/island_tangent.hpp"

namespace ashlar {

/// Applies the guess and its responses if its residual is smaller than the present one (largest norm on a body over
/// the largest force on it). The factor of the problem's solver changes in any case.
/// @param tangent of the problem
/// @return true if the guess was applied; false also if the system has no factor
[[nodiscard]] bool take_proximal_guess(IslandProblem& problem, IslandTangent& tangent);

}  // namespace ashlar
