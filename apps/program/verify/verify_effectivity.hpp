// Estimated errors over true ones, of problems with known answers.
#pragma once

#include <vector>

#include "apps/program/verify/verification.hpp"

namespace ashlar {

/// Ratios of the estimated relative error of a result to its true one: 0.5 to 3 passes. Orders: a bar that hangs, a
/// clamped beam and plate, Hertz's sphere, by goal_error.hpp; steps: a cube that swells, by motion_accuracy.hpp.
[[nodiscard]] std::vector<VerificationCheck> check_effectivity();

}  // namespace ashlar
