// Springs that are found anew hold no more energy than those they stand for.
//
// Each step makes new contact points: other overlap polygons, other feet, an edge that has become a face. At
// the same gaps, springs with more area, or deeper ones, would hold more energy than the pair of blocks held
// at the end of the step before, which no force has put in. Their rest is then taken to be where they hold
// just as much. A rest below the surface moves back to it as soon as springs found anew hold less, and all of
// the pair's springs are at rest where the pair held nothing.
#pragma once

#include <limits>
#include <vector>

namespace ashlar {

/// What the springs of a pair of blocks hold, J.
struct SpringEnergy {
  double normal = 0.0;
  double shear = 0.0;
};

/// No bound.
inline constexpr SpringEnergy any_spring_energy{std::numeric_limits<double>::infinity(),
                                                std::numeric_limits<double>::infinity()};

/// The rest r <= 0 of normal springs, nearest to 0, for which the sum of  k <r - g>^2 / 2  is at most `held`,
/// m. Monotone in each gap and in `held`.
/// @param stiffnesses k > 0, N/m, one for each point. @param gaps g, m. @param held J, >= 0 or infinity
[[nodiscard]] double rest_gap(const std::vector<double>& stiffnesses, const std::vector<double>& gaps,
                              double held);

}  // namespace ashlar
