// Onset of motion of blocks without equilibrium. The compliance of contacts and blocks influences the motion in an
// iteration of a static analysis: a tipping wall rests on the strip compressed by its springs, not on its edge.
// Unless the stiffness of a joint was given, blocks are therefore released from rest once more, from their positions
// in the iteration and nearly rigid. Closed contacts deform by far less than blocks move, and open ones never touch.
// Blocks start without strain and strain by far less than they move, too little to change their positions. If rigid
// blocks would stay at rest, the motion is due to compliance, in this and in later iterations.
#pragma once

#include <vector>

#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Removes the effect of compliance from the accelerations of an iteration of a static analysis.
/// @param problem solved, not accepted. @param accelerations (p, 3) of each moving block
/// @return true if all are those of rigid blocks now
[[nodiscard]] bool starts_rigidly(const BlockSystem& system, RunState& state, IslandSolvers& solvers,
                                  const StepProblem& problem, std::vector<Eigen::MatrixX3d>& accelerations);

}  // namespace ashlar
