#include "apps/scene/build/stress_field.hpp"

#include <algorithm>

#include "apps/scene/check/water_checks.hpp"
#include "apps/scene/expand/scene_stages.hpp"

namespace ashlar {

StressField initial_stress_of(const Scene& scene, std::size_t block) {
  const SceneInitialStress& initial = scene.initial_stress;
  const auto among = [&](const std::vector<std::string>& names) {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return means_block(scene, name, block); });
  };
  // Blocks that are placed later were not in the ground.
  const bool placed_later = std::any_of(scene.stage.begin(), scene.stage.end(),
                                        [&](const SceneStage& stage) { return among(stage.add); });
  if (!initial.given() || placed_later || !among(initial.blocks)) return nullptr;
  if (initial.stress.given())
    return [at = initial.stress.at](const Vector3& place) -> Eigen::Matrix3d {
      const std::vector<double> s = at(place);
      return (Eigen::Matrix3d() << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]).finished();
    };
  const SceneMaterial* material = find_material(scene, scene.block[block].material);
  const double own = material == nullptr ? 0.0 : material->density * scene.analysis.gravity.norm();
  const double weight = initial.unit_weight.value_or(own);
  const Vector3 up = up_of(scene);
  const Eigen::Matrix3d along = up * up.transpose();
  const Eigen::Matrix3d shape = along + *initial.k0 * (Eigen::Matrix3d::Identity() - along);
  return [weight, up, shape, surface = initial.surface](const Vector3& place) -> Eigen::Matrix3d {
    return -weight * std::max(0.0, surface - up.dot(place)) * shape;
  };
}

}  // namespace ashlar
