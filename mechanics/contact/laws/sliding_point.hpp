// Sliding of one contact point: functions shared by forces at the end of a step and mean forces (joint_law.cpp).
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "mechanics/contact/laws/joint_law.hpp"
#include "mechanics/contact/laws/shear_bound.hpp"

namespace ashlar {

/// Slip of a point that dilates: the root p of  trial - stiffness p = limit,  for a limit that does not decrease with
/// p.
/// @param stiffness > 0, N/m. @param bound_at limit at p and its derivative by p
template <class BoundAt>
double plastic_slip(double trial, double stiffness, BoundAt bound_at) {
  constexpr int most = 100;  // bisection converges to the last bit
  constexpr double rounding = 2.0 * std::numeric_limits<double>::epsilon();
  double low = 0.0;
  double high = trial / stiffness;
  double slip = 0.0;
  for (int k = 0; k < most; ++k) {
    const ShearBound bound = bound_at(slip);
    const double left = trial - stiffness * slip - bound.value;
    if (std::abs(left) <= rounding * trial) return slip;
    (left > 0.0 ? low : high) = slip;
    double next = slip + left / (stiffness + bound.slope);
    if (!(next > low && next < high)) next = k == 0 ? high : 0.5 * (low + high);
    if (next == slip || next == low || (next == high && k > 0)) return slip;
    slip = next;
  }
  return slip;
}

/// Derivatives of the forces of a sliding point.
struct Sliding {
  double normal_slope;  ///< -dN/dg without slip, N/m
  double limit_slope;   ///< the same of the limit
  double stiffness;     ///< of the trial shear force, N/m
  double dilation;
  double share;               ///< limit over trial force
  Eigen::Vector2d direction;  ///< unit, of the shear force
};

/// Sets the symmetric part of -d force / d (g, s), see Coupling. @return the rest
Coupling tangent_of(const Sliding& sliding, Eigen::Matrix3d& tangent);

}  // namespace ashlar
