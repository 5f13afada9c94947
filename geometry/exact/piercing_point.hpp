// The point where an edge goes through a plane, at the speed the corners of a common solid are asked for.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "geometry/exact/double_double.hpp"
#include "geometry/exact/number_vector.hpp"

namespace ashlar {

/// The point a + (b - a) s / (s - t), s = N . (a - c), t = N . (b - c), each coordinate rounded to nearest;
/// nullopt where about 95 bits of the exact value do not decide all three roundings.
///
/// Double-double arithmetic without the bound that DoubleDouble carries through every operation: few
/// operations, a proved bound for their sum.
/// @param n normal of the plane, c a point of it; a and b lie strictly on different sides. @pre coordinates
/// in the NumericRange of the floating rungs, rounding to nearest.
[[nodiscard]] std::optional<Eigen::Vector3d> quick_piercing_point(const NumberVector<DoubleDouble>& n,
                                                                  const Eigen::Vector3d& a,
                                                                  const Eigen::Vector3d& b,
                                                                  const Eigen::Vector3d& c);

}  // namespace ashlar
