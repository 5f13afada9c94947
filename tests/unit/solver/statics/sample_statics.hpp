// Blocks of rock for static analyses.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "solver/statics/static_analysis.hpp"
#include "support/simulations.hpp"

namespace ashlar::test_support {

inline const Material rock{2700.0, 1e10, 0.2};

template <class... Definitions>
std::vector<BlockModel> models(Definitions... definitions) {
  std::vector<BlockModel> result;
  (result.emplace_back(std::move(definitions)), ...);
  return result;
}

inline BlockDefinition fixed_block(Polyhedron solid) {
  BlockDefinition block = block_of("base", std::move(solid), rock, 1);
  block.fixed = true;
  return block;
}

/// A cube on a slope.
inline Simulation on_incline(double incline, double friction_angle, int order = 1) {
  JointLaw law{1e10, 1e10, std::tan(friction_angle * std::numbers::pi / 180.0), 0.0, 0.0, true};
  return Simulation(models(block_of("A", tilted_box({-0.5, -0.5, 0}, {0.5, 0.5, 1}, incline), rock, order),
                           fixed_block(tilted_box({-6, -2, -1}, {2, 2, 0}, incline))),
                    {{}, {}}, same_law(law), {});
}

}  // namespace ashlar::test_support
