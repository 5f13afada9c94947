// How blocks set off that no equilibrium holds. Where contacts and blocks give way has a part in the motion
// of an iteration of a static analysis: a tipping wall rests on the strip that its springs press in, not on
// its edge. Where no stiffness of a joint was asked for, blocks are therefore let go from rest once more,
// from where the iteration found them, all but rigid: contacts that it closed give way by far less than
// blocks move, those that it opened never touch, and blocks are without strain and strain by far less than
// they move, which is too little to change how they lie. Where rigid blocks would stay, it is by giving way
// that they move, then and after.
#pragma once

#include <vector>

#include "solver/step/run_context.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Takes what giving way does out of the accelerations of an iteration of a static analysis. Before the problem is
/// accepted.
/// @param accelerations (p, 3) of each moving block. @return whether all are those of rigid blocks now
[[nodiscard]] bool set_off(const RunContext& run, const TimeScheme& scheme, const StepProblem& problem,
                           std::vector<Eigen::MatrixX3d>& accelerations);

}  // namespace ashlar
