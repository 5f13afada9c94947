#include "apps/scene/assemble/water_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "apps/scene/check/water_checks.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "geometry/boxes/box_pairs.hpp"
#include "mechanics/contact/common_faces.hpp"

namespace ashlar {
namespace {

bool present(const Scene& scene, std::size_t block) {
  return scene.absent.empty() || !scene.absent[block];
}

}  // namespace

WaterLoads::WaterLoads(const LoadedScene& loaded, Diagnostics& diagnostics)
    : faces_(loaded.scene.block.size(), -1), parts_(loaded.scene.block.size()) {
  const Scene& scene = loaded.scene;
  const Vector3 up = up_of(scene);
  for (const SceneWater& water : scene.water) {
    const int index = static_cast<int>(waters_.size());
    waters_.push_back({JointSelection(scene, water.joints),
                       water.file ? WaterLevel(height_field(water.surface))
                                  : WaterLevel(Plane{water.level.point, water.level.normal}, up),
                       water.unit_weight});
    for (std::size_t k = 0; k < faces_.size(); ++k)
      if (means_block(scene, water.faces, k)) faces_[k] = index;
  }
  if (waters_.empty()) return;
  add_free_faces(loaded, diagnostics);
  add_joints(loaded, diagnostics);
}

Load WaterLoads::of_block(std::size_t block) const {
  Load load;
  load.parts = parts_[block];
  return load;
}

int WaterLoads::water_of_joint(std::size_t a, std::size_t b) const {
  int water = static_cast<int>(waters_.size()) - 1;
  while (water >= 0 && !waters_[static_cast<std::size_t>(water)].joints.contains(a, b)) --water;
  return water;
}

double WaterLoads::in_joint(std::size_t a, std::size_t b, const Vector3& place) const {
  const int water = water_of_joint(a, b);
  if (water < 0) return 0.0;
  const Water& one = waters_[static_cast<std::size_t>(water)];
  return one.unit_weight * std::max(0.0, one.level.depth(place).value_or(0.0));
}

void WaterLoads::press(const LoadedScene& loaded, int water, std::size_t block,
                       const std::vector<Vector3>& polygon, const Vector3& inward, double sign,
                       Diagnostics& diagnostics) {
  if (water < 0 || loaded.scene.block[block].fixed) return;
  const auto index = static_cast<std::size_t>(water);
  const Water& one = waters_[index];
  for (const Vector3& corner : polygon) {
    if (one.level.depth(corner)) continue;
    diagnostics.error(
        loaded.scene.places.value(fmt::format("water.{}.level.file", index)),
        fmt::format("level of water is not known over block \"{}\" (at x = {:g}, y = {:g}), points around "
                    "all blocks that it presses on are needed",
                    loaded.scene.block[block].name, corner.x(), corner.y()));
    return;
  }
  for (LinearPatch& part : one.level.below(polygon)) {
    part.value *= sign * one.unit_weight;
    part.gradient *= sign * one.unit_weight;
    parts_[block].push_back({std::move(part), inward});
  }
}

void WaterLoads::add_free_faces(const LoadedScene& loaded, Diagnostics& diagnostics) {
  for (std::size_t k = 0; k < loaded.solids.size(); ++k) {
    if (faces_[k] < 0 || !present(loaded.scene, k)) continue;
    const Polyhedron& solid = loaded.solids[k];
    for (const PolyhedronFace& face : solid.faces()) {
      for (const int triangle : face.triangles) {
        std::vector<Vector3> corners;
        for (const int point : solid.mesh().triangles[static_cast<std::size_t>(triangle)])
          corners.push_back(solid.mesh().points[static_cast<std::size_t>(point)]);
        press(loaded, faces_[k], k, corners, -face.normal, 1.0, diagnostics);
        if (!diagnostics.good()) return;
      }
    }
  }
}

void WaterLoads::add_joints(const LoadedScene& loaded, Diagnostics& diagnostics) {
  std::vector<Box> boxes;
  for (const Polyhedron& solid : loaded.solids)
    boxes.push_back(box_of(solid.mesh().points).grown(allowed_offset(solid)));
  for (const std::array<int, 2>& pair : meeting_boxes(boxes)) {
    const auto a = static_cast<std::size_t>(pair[0]), b = static_cast<std::size_t>(pair[1]);
    if (!present(loaded.scene, a) || !present(loaded.scene, b)) continue;
    const int joint = water_of_joint(a, b);
    if (joint < 0 && faces_[a] < 0 && faces_[b] < 0) continue;
    for (const CommonPolygon& common : common_polygons(loaded.solids[a], loaded.solids[b])) {
      std::vector<Vector3> corners;
      for (const Eigen::Vector2d& corner : common.corners) corners.push_back(common.point(corner));
      const Vector3& outward = common.frame.w;
      // A joint is no free face.
      press(loaded, faces_[a], a, corners, -outward, -1.0, diagnostics);
      press(loaded, faces_[b], b, corners, outward, -1.0, diagnostics);
      press(loaded, joint, a, corners, -outward, 1.0, diagnostics);
      press(loaded, joint, b, corners, outward, 1.0, diagnostics);
      if (!diagnostics.good()) return;
    }
  }
}

}  // namespace ashlar
