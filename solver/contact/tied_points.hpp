// Tied blocks as contact points: each function of their gap (mechanics/contact/laws/tie.hpp) is a point that never opens or
// slides, with the components of the function's coefficient along x, y and z as gap and slip.
#pragma once

#include <vector>

#include "mechanics/contact/contact_memory.hpp"
#include "mechanics/contact/laws/joint_law.hpp"
#include "mechanics/contact/laws/tie.hpp"

namespace ashlar {

/// Coefficients of the gap of two tied blocks, m. @return (#functions, 3)
[[nodiscard]] Eigen::MatrixX3d tie_gap(const Tie& tie, const BlockState& a, const BlockState& b);

/// One point for each function of the gap, of unit area. @param gap (#functions, 3)
[[nodiscard]] std::vector<ContactPoint> tie_points(const Eigen::MatrixX3d& gap);
/// Memory of these points: locked, with their slip.
[[nodiscard]] std::vector<PointMemory> tie_memory(const Eigen::MatrixX3d& gap);

/// Springs in all directions that cannot fail. @param stiffness Pa/m
[[nodiscard]] JointLaw unbreakable_law(double stiffness);

}  // namespace ashlar
