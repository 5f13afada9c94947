// Values of several cases and studies.
#pragma once

#include <cmath>

#include "mechanics/material/material.hpp"
#include "solver/limit/limit_trial.hpp"

namespace ashlar {

inline constexpr double earth_gravity = 9.81;  ///< m/s^2

inline const Material common_rock{2500.0, 1e10, 0.2};

/// Geometric mean of the two bounds of a limit. Not a number unless both are known within the search's tolerance.
[[nodiscard]] inline double middle(const LimitBracket& bracket) {
  const bool known = bracket.resolved && bracket.lower && bracket.upper;
  return known ? std::sqrt(*bracket.lower * *bracket.upper) : std::nan("");
}

}  // namespace ashlar
