#include "solver/ground/water_pressure.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/boxes/box_pairs.hpp"
#include "mechanics/contact/common_faces.hpp"

namespace ashlar {

WaterPressure::WaterPressure(std::vector<GroundWater> waters, const std::vector<GroundBlock>& blocks)
    : waters_(std::move(waters)), faces_(blocks.size(), -1), parts_(blocks.size()) {
  for (std::size_t water = 0; water < waters_.size(); ++water)
    for (std::size_t k = 0; k < faces_.size(); ++k)
      if (waters_[water].faces.empty() || waters_[water].faces[k]) faces_[k] = static_cast<int>(water);
  if (waters_.empty()) return;
  add_free_faces(blocks);
  add_joints(blocks);
}

Load WaterPressure::of_block(std::size_t block) const {
  Load load;
  load.parts = parts_[block];
  return load;
}

int WaterPressure::water_of_joint(std::size_t a, std::size_t b) const {
  int water = static_cast<int>(waters_.size()) - 1;
  for (; water >= 0; --water) {
    const GroundWater& one = waters_[static_cast<std::size_t>(water)];
    if (!one.joints || one.joints(a, b)) break;
  }
  return water;
}

double WaterPressure::in_joint(std::size_t a, std::size_t b, const Vector3& place) const {
  const int water = water_of_joint(a, b);
  if (water < 0) return 0.0;
  const GroundWater& one = waters_[static_cast<std::size_t>(water)];
  return one.unit_weight * std::max(0.0, one.level.depth(place).value_or(0.0));
}

void WaterPressure::press(const std::vector<GroundBlock>& blocks, int water, std::size_t block,
                          const std::vector<Vector3>& polygon, const Vector3& inward, double sign) {
  if (water < 0 || blocks[block].fixed) return;
  const auto index = static_cast<std::size_t>(water);
  const GroundWater& one = waters_[index];
  for (const Vector3& corner : polygon) {
    if (one.level.depth(corner)) continue;
    unknown_.push_back({index, block, corner});
    return;
  }
  for (LinearPatch& part : one.level.below(polygon)) {
    part.value *= sign * one.unit_weight;
    part.gradient *= sign * one.unit_weight;
    parts_[block].push_back({std::move(part), inward});
  }
}

void WaterPressure::add_free_faces(const std::vector<GroundBlock>& blocks) {
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (faces_[k] < 0 || !blocks[k].present || blocks[k].solid == nullptr) continue;
    const Polyhedron& solid = *blocks[k].solid;
    for (const PolyhedronFace& face : solid.faces()) {
      for (const int triangle : face.triangles) {
        std::vector<Vector3> corners;
        for (const int point : solid.mesh().triangles[static_cast<std::size_t>(triangle)])
          corners.push_back(solid.mesh().points[static_cast<std::size_t>(point)]);
        press(blocks, faces_[k], k, corners, -face.normal, 1.0);
        if (!unknown_.empty()) return;
      }
    }
  }
}

void WaterPressure::add_joints(const std::vector<GroundBlock>& blocks) {
  std::vector<Box> boxes;
  for (const GroundBlock& block : blocks)
    boxes.push_back(block.solid == nullptr
                        ? Box()
                        : box_of(block.solid->mesh().points).grown(allowed_offset(*block.solid)));
  for (const std::array<int, 2>& pair : meeting_boxes(boxes)) {
    const auto a = static_cast<std::size_t>(pair[0]), b = static_cast<std::size_t>(pair[1]);
    if (!blocks[a].present || !blocks[b].present) continue;
    const int joint = water_of_joint(a, b);
    if (joint < 0 && faces_[a] < 0 && faces_[b] < 0) continue;
    for (const CommonPolygon& common : common_polygons(*blocks[a].solid, *blocks[b].solid)) {
      std::vector<Vector3> corners;
      for (const Eigen::Vector2d& corner : common.corners) corners.push_back(common.point(corner));
      const Vector3& outward = common.frame.w;
      // A joint is no free face.
      press(blocks, faces_[a], a, corners, -outward, -1.0);
      press(blocks, faces_[b], b, corners, outward, -1.0);
      press(blocks, joint, a, corners, -outward, 1.0);
      press(blocks, joint, b, corners, outward, 1.0);
      if (!unknown_.empty()) return;
    }
  }
}

}  // namespace ashlar
