#include "apps/scene/assemble/stress_field.hpp"

#include <fmt/format.h>

#include <optional>
#include <span>
#include <stdexcept>

#include "apps/scene/check/water_checks.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/toml/formulas.hpp"
#include "solver/ground/ground_stress.hpp"
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
      const std::vector<double> components = at(place);
      return symmetric_stress(std::span<const double, 6>(components));
    };
  const SceneMaterial* material = find_material(scene, scene.block[block].material);
  const double own = material == nullptr ? 0.0 : material->density * scene.analysis.gravity.norm();
  return stress_at_rest({.unit_weight = initial.unit_weight.value_or(own),
                         .k0 = *initial.k0,
                         .surface = initial.surface,
                         .up = up_of(scene)});
}

void start_under_stress(const Scene& scene, Simulation& simulation, Diagnostics& diagnostics) {
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
  if (!worst || !worst->is_notable()) return;
  diagnostics.warning(
      scene.places.key("initial_stress"),
      fmt::format(
          "initial stress is not in balance with weight, loads and boundaries: block \"{}\" lacks {:.3g} N "
          "({:.1f} % of the forces on it) and moves until they balance; check tractions, supports and k0",
          scene.block[static_cast<std::size_t>(worst->block)].name, worst->force, 100 * worst->share));
}

}  // namespace ashlar
