// Steps in which a deformable block turns far. With average-acceleration and generalized-alpha a stiff block that spins
// gains energy that grows with the turn of a step: 5 % in 100 steps of 0.1 rad, without bound from 0.3 rad on (notes/
// turn_limit.md). Their steps are shortened before they are solved. With dda a block loses less than 1 % in 100 steps of
// 0.3 rad, and rigid blocks turn exactly.
#pragma once

#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"

namespace ashlar {

/// Rotation of a block between two configurations, rad: that of the rigid motion closest to them, to first order.
/// @param before,after positions, (p, 3)
[[nodiscard]] double turn_between(const Eigen::MatrixX3d& before, const Eigen::MatrixX3d& after);

/// Step in which no deformable block turns by more than the integrator allows, at its present velocity, s. Shortened
/// ones are counted. Collective. @param step s
[[nodiscard]] double limited_by_turns(const BlockSystem& system, RunState& state, double step);

}  // namespace ashlar
