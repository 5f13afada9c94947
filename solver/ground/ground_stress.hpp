// Stress of the ground as a field, for the blocks and joints that begin under it (BlockDefinition::initial_stress,
// initial_stress.hpp).
//
// At rest below a level surface the vertical stress is minus the weight above, and the stress across it k0 times as much
// (k0: coefficient of earth pressure at rest; Terzaghi, Theoretical Soil Mechanics, 1943):
//   s(X) = -unit_weight max(0, surface - u . X) (u u' + k0 (1 - u u'))       u: unit vector against gravity
#pragma once

#include <span>

#include "mechanics/material/initial_stress.hpp"

namespace ashlar {

/// Ground at rest below a level surface.
struct GroundAtRest {
  double unit_weight = 0.0;       ///< N/m^3
  double k0 = 1.0;                ///< stress across over stress along gravity
  double surface = 0.0;           ///< m, height along `up`; none is stressed above it
  Vector3 up = Vector3::UnitZ();  ///< unit, against gravity
};

/// s, Pa, tension positive.
[[nodiscard]] StressField stress_at_rest(const GroundAtRest& ground);

/// A stress by its components. @param components xx, yy, zz, xy, yz, zx, Pa. @return symmetric
[[nodiscard]] Eigen::Matrix3d symmetric_stress(std::span<const double, 6> components);

}  // namespace ashlar
