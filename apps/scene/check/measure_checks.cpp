#include "apps/scene/check/measure_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "apps/scene/check/water_checks.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/model/level_blocks.hpp"

namespace ashlar {

void check_group_measures(const Scene& scene, Diagnostics& of_blocks) {
  for (std::size_t i = 0; i < scene.measure.size(); ++i) {
    const SceneMeasure& measure = scene.measure[i];
    const std::string path = fmt::format("measure.{}", i);
    if (!measure.drift && !measure.crack) continue;
    if (measure.drift)
      check_patterns(scene, path + ".drift.blocks", measure.drift->blocks, false, of_blocks, "drift");
    if (!measure.crack) continue;
    check_patterns(scene, path + ".crack.joints", measure.crack->joints, true, of_blocks, "crack");
    check_patterns(scene, path + ".crack.to", measure.crack->to, false, of_blocks, "crack");
  }
}

void check_levels(const Scene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                  Diagnostics& diagnostics) {
  const Vector3 up = up_of(scene);
  for (std::size_t i = 0; i < scene.measure.size(); ++i) {
    if (!scene.measure[i].drift) continue;
    const SceneDrift& drift = *scene.measure[i].drift;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    std::array<bool, 2> reached = {false, false};
    for (std::size_t k = 0; k < scene.block.size(); ++k) {
      if (!solids[k] || !means_block(scene, drift.blocks, k)) continue;
      const std::vector<Vector3>& points = solids[k]->mesh().points;
      for (const Vector3& point : points) {
        low = std::min(low, up.dot(point));
        high = std::max(high, up.dot(point));
      }
      for (std::size_t end = 0; end < 2; ++end)
        reached.at(end) = reached.at(end) || reaches_level(points, up, drift.heights.at(end));
    }
    if (!(low <= high)) continue;  // its names are wrong
    const double datum = up.dot(scene.origin);
    for (std::size_t end = 0; end < 2; ++end) {
      if (reached.at(end)) continue;
      diagnostics.error(
          scene.places.value(fmt::format("measure.{}.drift.heights", i)),
          fmt::format(
              "no block of the drift is at the {} level ({} m), its blocks reach from {:.6g} to {:.6g} m",
              end == 0 ? "lower" : "upper", datum + drift.heights.at(end), datum + low, datum + high));
    }
  }
}

}  // namespace ashlar
