#include "apps/scene/assemble/water_loads.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "apps/scene/assemble/joint_selection.hpp"
#include "apps/scene/check/water_checks.hpp"
#include "apps/scene/expand/ground_of_scene.hpp"
#include "apps/scene/expand/scene_stages.hpp"

namespace ashlar {
namespace {

GroundWater water_of(const Scene& scene, const SceneWater& water) {
  GroundWater result{water.file ? WaterLevel(height_field(water.surface))
                                : WaterLevel(Plane{water.level.point, water.level.normal}, up_of(scene)),
                     water.unit_weight,
                     [joints = JointSelection(scene, water.joints)](std::size_t a, std::size_t b) {
                       return joints.contains(a, b);
                     }};
  for (std::size_t k = 0; k < scene.block.size(); ++k)
    result.faces.push_back(means_block(scene, water.faces, k));
  return result;
}

}  // namespace

WaterPressure water_pressure_of(const LoadedScene& loaded, Diagnostics& diagnostics) {
  const Scene& scene = loaded.scene;
  std::vector<GroundWater> waters;
  for (const SceneWater& water : scene.water) waters.push_back(water_of(scene, water));
  WaterPressure pressure(std::move(waters), ground_blocks_of(scene, loaded.solids));
  for (const auto& [water, block, place] : pressure.unknown_levels())
    diagnostics.error(
        scene.places.value(fmt::format("water.{}.level.file", water)),
        fmt::format("level of water is not known over block \"{}\" (at x = {:g}, y = {:g}), points around "
                    "all blocks that it presses on are needed",
                    scene.block[block].name, place.x(), place.y()));
  return pressure;
}

}  // namespace ashlar
