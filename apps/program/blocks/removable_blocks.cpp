#include "apps/program/blocks/removable_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "apps/scene/model/joint_table.hpp"

namespace ashlar {
namespace {

/// Areas of contact are rounded; a face is covered if at most this part of it is not.
constexpr double covered_part = 1e-9;

struct Hold {
  double area = 0.0;      ///< m^2
  double friction = 0.0;  ///< tangent times area
};

using Holds = std::map<std::pair<int, bool>, Hold>;  // by plane and side

bool has_free_face(const BlockReport& report, std::size_t index, const Holds& holds) {
  const BlockSolid block = report.solid(index);
  std::map<std::pair<int, bool>, double> bare;
  for (const PieceFace& face : block.solid->faces(block.piece))
    if (report.is_bare(index, face)) bare[{face.plane, face.below}] += block.solid->area(face);
  return std::any_of(bare.begin(), bare.end(), [&](const auto& entry) {
    const auto& [plane, area] = entry;
    const auto hold = holds.find(plane);
    // Areas of neighbours within the solid are not on a bare face.
    double covered = hold == holds.end() ? 0.0 : hold->second.area;
    for (const PieceFace& face : block.solid->faces(block.piece))
      if (!report.is_bare(index, face) && std::pair(face.plane, face.below) == plane)
        covered -= block.solid->area(face);
    return area - covered > covered_part * area;
  });
}

double factor_of(const KeyBlock& key, const std::vector<HeldFace>& held, const Holds& holds) {
  if (key.mode == BlockMode::falling) return 0.0;
  if (key.mode != BlockMode::sliding_on_one && key.mode != BlockMode::sliding_on_two)
    return std::numeric_limits<double>::infinity();
  double strength = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    if (key.faces[k] < 0) continue;
    const HeldFace& face = held[static_cast<std::size_t>(key.faces[k])];
    const Hold& hold = holds.at({face.plane, face.below});
    strength += key.pressure[k] * hold.friction / hold.area;
  }
  return strength / key.thrust;
}

}  // namespace

std::vector<RemovableBlock> find_removable_blocks(const BlockReport& report, const Vector3& force) {
  const Scene& scene = report.loaded().scene;
  const JointTable table(scene);
  std::vector<RemovableBlock> result;
  for (std::size_t k = 0; k < scene.block.size(); ++k) {
    if (!report.is_there(k) || scene.block[k].fixed || !scene.block[k].fix.empty()) continue;
    Holds holds;
    bool tied = false;
    for (const BlockBorder& border : report.blocks()[k].borders) {
      const SceneJointLaw law = table.law_between(k, border.block);
      tied = tied || law.tied || law.tie;
      Hold& hold = holds[{border.plane, border.below}];
      hold.area += border.area;
      hold.friction += border.area * std::tan(law.friction_angle * std::numbers::pi / 180.0);
    }
    const BlockSolid block = report.solid(k);
    if (tied || !has_free_face(report, k, holds)) continue;
    std::vector<HeldFace> held;
    for (const auto& [plane, hold] : holds) held.push_back({plane.first, plane.second});
    const KeyBlock key = block.solid->key_block(block.piece, held, force);
    result.push_back({k, key, factor_of(key, held, holds)});
  }
  return result;
}

}  // namespace ashlar
