#include "solver/state/automatic.hpp"

#include <algorithm>

namespace ashlar {

StiffnessSource stiffness_source(const BlockModel& block) {
  return {block.size(), block.fixed() ? 0.0 : block.material().young_modulus, block.fixed()};
}

double automatic_normal_stiffness(const StiffnessSource& a, const StiffnessSource& b, bool area_springs,
                                  const AutomaticRatios& ratios) {
  // The modulus of a fixed block is irrelevant, as it is rigid.
  const double modulus =
      std::min(a.fixed ? b.young_modulus : a.young_modulus, b.fixed ? a.young_modulus : b.young_modulus);
  double size = std::min(a.size, b.size);
  if (a.fixed != b.fixed) size = a.fixed ? b.size : a.size;
  return ratios.normal_stiffness * modulus / size * (area_springs ? 1.0 : size * size);
}

double automatic_tie_stiffness(const StiffnessSource& a, const StiffnessSource& b,
                               const AutomaticRatios& ratios) {
  const auto stiffness = [](const StiffnessSource& block) {
    return block.fixed ? 0.0 : block.young_modulus / block.size;
  };
  return ratios.tie_stiffness * std::max(stiffness(a), stiffness(b));
}

double automatic_tie_stiffness(const BlockModel& a, const BlockModel& b, const AutomaticRatios& ratios) {
  return automatic_tie_stiffness(stiffness_source(a), stiffness_source(b), ratios);
}

}  // namespace ashlar
