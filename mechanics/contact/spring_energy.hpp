// Springs that are found anew hold no more energy than those they stand for.
//
// Each step makes new contact points: other overlap polygons, other feet, an edge that has become a face, a
// face that bulges and is divided. At the same gaps, springs with more area, or deeper ones, would hold more
// energy than the pair of blocks held at the end of the step before, which no force has put in. Springs that
// would are at rest below the surface: each where it holds what is remembered of its place, so that a point
// that is found deep where nothing was known starts without a force, and those around it go on to carry what
// they carried. Rests move back to the surface as far as the energy held allows.
#pragma once

#include <limits>
#include <vector>

namespace ashlar {

/// What the springs of a pair of blocks hold, J.
struct SpringEnergy {
  double normal = 0.0;
  double shear = 0.0;

  [[nodiscard]] double total() const { return normal + shear; }
};

/// No bound.
inline constexpr SpringEnergy any_spring_energy{std::numeric_limits<double>::infinity(),
                                                std::numeric_limits<double>::infinity()};

/// The rest r <= 0 of normal springs, nearest to 0, for which the sum of  k <r - g>^2 / 2  is at most `held`,
/// m. Monotone in each gap and in `held`.
/// @param stiffnesses k > 0, N/m, one for each point. @param gaps g, m. @param held J, >= 0 or infinity
[[nodiscard]] double rest_gap(const std::vector<double>& stiffnesses, const std::vector<double>& gaps,
                              double held);

/// Rests of normal springs found anew, m, <= 0: all 0, the surface, if they hold at most `held` then; else
/// the remembered ones, those of springs that are open there at their gaps; of these the least share that
/// holds at most `held`, or, where they all hold that (to a billionth: rounding must not choose) or more, all
/// of them and rest_gap() below these.
/// @param remembered rests <= 0, m, one for each point; others as in rest_gap()
[[nodiscard]] std::vector<double> rest_gaps(const std::vector<double>& stiffnesses,
                                            const std::vector<double>& gaps,
                                            const std::vector<double>& remembered, double held);

}  // namespace ashlar
