#include "apps/scene/check/water_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/model/name_pattern.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "mechanics/supports/water_level.hpp"

namespace ashlar {
namespace {

void check_level(const Scene& scene, const SceneWater& water, const std::string& path,
                 Diagnostics& diagnostics) {
  try {
    if (water.file) {
      (void)height_field(water.surface);
    } else if (water.level.point.allFinite() && water.level.normal.allFinite()) {
      (void)WaterLevel(Plane{water.level.point, water.level.normal}, up_of(scene));
    }
  } catch (const std::invalid_argument& error) {
    diagnostics.error(
        scene.places.value(path + (water.file ? ".level.file" : ".level.normal")),
        fmt::format("water has no level ({}), {} is needed", error.what(),
                    water.file ? "one height for each of at least three places that are not on a line"
                               : "a plane that gravity crosses"));
  }
}

}  // namespace

void check_patterns(const Scene& scene, const std::string& key, const std::vector<std::string>& patterns,
                    bool of_cuts, Diagnostics& of_blocks, const char* what) {
  for (const std::string& pattern : patterns) {
    bool any = of_cuts && std::any_of(scene.cut.begin(), scene.cut.end(), [&](const SceneCut& cut) {
                 return pattern_matches(pattern, cut.name);
               });
    for (std::size_t k = 0; k < scene.block.size() && !any; ++k) any = means_block(scene, pattern, k);
    if (any) continue;
    std::vector<std::string> names;
    for (const SceneBlock& block : scene.block) names.push_back(block.name);
    if (of_cuts)
      for (const SceneCut& cut : scene.cut) names.push_back(cut.name);
    of_blocks.error(
        scene.places.value(key),
        fmt::format(
            "{} names no {} (\"{}\"), {}the name of a [[block]]{} or a glob that matches one is needed", what,
            of_cuts ? "joint" : "block", pattern, guess_block(pattern, names),
            of_cuts ? " or a [[cut]]" : ""));
  }
}

void check_water(const Scene& scene, Diagnostics& diagnostics, Diagnostics& of_blocks) {
  for (std::size_t i = 0; i < scene.water.size(); ++i) {
    const SceneWater& water = scene.water[i];
    const std::string path = fmt::format("water.{}", i);
    check_level(scene, water, path, diagnostics);
    check_patterns(scene, path + ".joints", water.joints, true, of_blocks, "water");
    check_patterns(scene, path + ".faces", water.faces, false, of_blocks, "water");
  }
}

void check_initial_stress(const Scene& scene, Diagnostics& diagnostics, Diagnostics& of_blocks) {
  const SceneInitialStress& initial = scene.initial_stress;
  if (!initial.given()) return;
  check_patterns(scene, "initial_stress.blocks", initial.blocks, false, of_blocks, "initial_stress");
  for (std::size_t k = 0; k < scene.block.size(); ++k) {
    const SceneBlock& block = scene.block[k];
    const SceneMaterial* material = find_material(scene, block.material);
    if (block.fixed || block.order == 0 || material == nullptr ||
        material->elasticity == SceneMaterial::Elasticity::linear)
      continue;
    if (!means_block(scene, initial.blocks, k)) continue;
    diagnostics.error(scene.places.key("initial_stress"),
                      fmt::format("initial stress in a block of elasticity \"st-venant-kirchhoff\" (\"{}\"), "
                                  "\"linear\" is needed",
                                  block.name));
    return;
  }
}

Vector3 up_of(const Scene& scene) {
  const Vector3& gravity = scene.analysis.gravity;
  return gravity.isZero(0.0) || !scene.analysis.gravity_history.empty() ? Vector3(Vector3::UnitZ())
                                                                        : Vector3(-gravity.normalized());
}

}  // namespace ashlar
