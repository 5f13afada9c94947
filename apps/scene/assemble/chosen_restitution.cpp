#include "apps/scene/assemble/chosen_restitution.hpp"

#include <cmath>

namespace ashlar {

ChosenRestitution::ChosenRestitution(const Scene& scene, const std::vector<BlockSummary>& blocks)
    : blocks_(blocks),
      chooses_(!is_static(scene.analysis) &&
               scene.analysis.formulation != SceneAnalysis::Formulation::incremental),
      area_(scene.contact.springs == SceneContact::Springs::area),
      step_(scene.analysis.time_step) {}

bool ChosenRestitution::resolves_springs(std::size_t block, double stiffness) const {
  // A block on the springs of a face. In half a period, which is an impact, ten steps.
  constexpr double resolved = 0.3;
  const BlockSummary& of = blocks_[block];
  if (of.fixed()) return false;
  const double size = of.stiffness.size;
  const double whole = area_ ? stiffness * size * size : stiffness;  // N/m
  return std::sqrt(whole / of.mass) * step_ <= resolved;
}

std::optional<double> ChosenRestitution::of(std::size_t a, std::size_t b, const SceneJointLaw& law) const {
  if (law.restitution) return *law.restitution;
  if (!chooses_ || law.damping > 0.0) return std::nullopt;
  for (const std::size_t block : {a, b}) {
    if (blocks_[block].slowest_vibration * step_ <= resolved_angle) return std::nullopt;
    if (law.normal_stiffness && resolves_springs(block, *law.normal_stiffness)) return std::nullopt;
  }
  return 0.0;
}

}  // namespace ashlar
