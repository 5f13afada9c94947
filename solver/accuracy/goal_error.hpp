// Errors of the goals of an equilibrium by the orders of blocks, from one linear solution with higher orders.
//
// Every block that deforms gets the functions of the next two orders (order_error.hpp tells why two) beside its own. With
// K the tangent of all blocks, contacts, ties and bolts on these functions at the present state, and r the residual,
// which is zero on the functions that the blocks have,
//     K d = r,     error of a goal J:  J(u + d) - J(u) = J' d = z r,   K' z = J'                                  (1)
// z is the dual solution of R. Becker and R. Rannacher, Acta Numerica 10 (2001) 1, in the same space: d provides the
// same number for all goals at once, and forces as well, which change by the stiffness of their points. Contact
// points keep their place and state: open ones stay open, locked and sliding ones change their forces as their laws do.
// Points with multipliers have 1000 times the stiffness of their springs, as multipliers let them move by nothing.
//
// (1) is the difference to the goal with the next two orders, to first order in d. It is the error up to that of those
// orders. Rigid blocks stay rigid.
//
// Notes: notes/accuracy.md.
#pragma once

#include <vector>

#include "solver/accuracy/static_accuracy.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Largest number of unknowns with the next orders for which errors of goals are estimated: their matrix is factorised
/// once.
inline constexpr int largest_goal_system = 20000;

struct GoalError {
  std::vector<double> change;  ///< of the goal's values by the next two orders
  double relative = 0.0;  ///< length of the change over that of the changed values, or over Goal::least if
                          ///< that is larger; infinite if both are 0
};

/// After an equilibrium of a static analysis. @return by goal; empty without goals, for incremental blocks, for a system
/// larger than largest_goal_system, and where no block has another order
[[nodiscard]] std::vector<GoalError> goal_errors(const Simulation& simulation, const GoalValues& goals);

}  // namespace ashlar
