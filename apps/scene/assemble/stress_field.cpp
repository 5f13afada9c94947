#include "apps/scene/assemble/stress_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "apps/scene/check/water_checks.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/toml/formulas.hpp"
#include "solver/ranks/ranks.hpp"

namespace ashlar {

StressField initial_stress_of(const Scene& scene, std::size_t block, std::size_t stage) {
  const SceneInitialStress& initial = scene.initial_stress;
  if (!initial.given() || !means_block(scene, initial.blocks, block)) return nullptr;
  // Blocks that have been added were not in the ground.
  for (std::size_t s = 0; s <= stage && s < scene.stage.size(); ++s)
    if (means_block(scene, scene.stage[s].add, block)) return nullptr;
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

void start_under_stress(const Scene& scene, Simulation& simulation, Diagnostics& diagnostics) {
  constexpr double reported_from = 0.01;
  std::optional<StressImbalance> worst;
  const auto refuse = [&](const std::exception& error) {
    diagnostics.error(scene.places.key("initial_stress"),
                      fmt::format("initial stress has no value on a joint ({})", error.what()));
  };
  try {
    worst = simulation.start_stressed();
  } catch (const FormulaError& error) {
    refuse(error);
  } catch (const OtherRankFailed&) {
    throw;
  } catch (const std::runtime_error& error) {
    // The first rank is told the error of another one as text.
    if (simulation.system().exchange().alone()) throw;
    refuse(error);
  }
  if (!worst || worst->share < reported_from) return;
  diagnostics.warning(
      scene.places.key("initial_stress"),
      fmt::format(
          "initial stress is not in balance with weight, loads and boundaries: block \"{}\" lacks {:.3g} N "
          "({:.1f} % of the forces on it) and moves until they balance; check tractions, supports and k0",
          scene.block[static_cast<std::size_t>(worst->block)].name, worst->force, 100 * worst->share));
}

}  // namespace ashlar
