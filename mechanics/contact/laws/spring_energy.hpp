// Energy bound of re-detected springs.
//
// Each step makes new contact points: other overlap polygons, other feet, an edge that has become a face, a face that
// bulges and is divided. At the same gaps, springs with more area, or deeper ones, would hold more energy than the
// pair of blocks had at the end of the step before, without work of any force. Such springs get a rest gap below the
// surface, at which each keeps the remembered energy of its place. So a point detected deep without memory starts
// without force, and the points around it keep their load. Rest gaps return to the surface as far as the energy
// allows.
#pragma once

#include <limits>
#include <vector>

#include "mechanics/contact/laws/normal_spring.hpp"

namespace ashlar {

/// Energy of the springs of a pair of blocks, J.
struct SpringEnergy {
  double normal = 0.0;
  double shear = 0.0;

  [[nodiscard]] double total() const { return normal + shear; }
};

/// No bound.
inline constexpr SpringEnergy any_spring_energy{std::numeric_limits<double>::infinity(),
                                                std::numeric_limits<double>::infinity()};

/// The rest gap r <= 0 of normal springs, closest to 0, for which springs of the closures  <r - g>  hold at most `held`, m.
/// Monotone in each gap and in `held`.
/// @param springs one for each point. @param gaps g, m. @param held J, >= 0 or infinity
[[nodiscard]] double rest_gap(const std::vector<NormalSpring>& springs, const std::vector<double>& gaps,
                              double held);

/// Rest gaps of re-detected normal springs, m, <= 0. All are 0, the surface, if the springs hold at most `held` then.
/// Otherwise they are the remembered ones (for springs open there, their gaps), scaled by the smallest share with at
/// most `held`. If the full remembered ones still hold that (to a billionth: rounding must not decide) or more, they
/// are lowered by rest_gap().
/// @param remembered rest gaps <= 0, m, one for each point; others as in rest_gap()
[[nodiscard]] std::vector<double> rest_gaps(const std::vector<NormalSpring>& springs,
                                            const std::vector<double>& gaps,
                                            const std::vector<double>& remembered, double held);

}  // namespace ashlar
