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

}  // namespace ashlar
