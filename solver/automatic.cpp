#include "solver/automatic.hpp"

#include <algorithm>
#include <cmath>

namespace ashlar {

double block_size(const BlockModel& block) {
  return std::cbrt(block.basis().volume());
}

double automatic_normal_stiffness(const BlockModel& a, const BlockModel& b, bool area_springs,
                                  const AutomaticRatios& ratios) {
  // A fixed block is rigid, so the other one gives the modulus.
  double modulus = std::min(a.fixed() ? b.material().young_modulus : a.material().young_modulus,
                            b.fixed() ? a.material().young_modulus : b.material().young_modulus);
  double size = std::min(block_size(a), block_size(b));
  if (a.fixed() != b.fixed()) size = block_size(a.fixed() ? b : a);
  return ratios.normal_stiffness * modulus / size * (area_springs ? 1.0 : size * size);
}

double automatic_tie_stiffness(const BlockModel& a, const BlockModel& b, const AutomaticRatios& ratios) {
  const auto stiffness = [](const BlockModel& block) {
    return block.fixed() ? 0.0 : block.material().young_modulus / block_size(block);
  };
  return ratios.tie_stiffness * std::max(stiffness(a), stiffness(b));
}

}  // namespace ashlar
