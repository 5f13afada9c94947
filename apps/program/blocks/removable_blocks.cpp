#include "apps/program/blocks/removable_blocks.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "apps/scene/model/joint_table.hpp"
#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"
#include "mechanics/supports/face_selection.hpp"

namespace ashlar {
namespace {

/// Areas of contact are rounded; a face is covered if at most this part of it is not.
constexpr double covered_part = 1e-9;

struct Hold {
  double area = 0.0;      ///< m^2
  double friction = 0.0;  ///< tangent times area
};

using Holds = std::map<std::pair<int, bool>, Hold>;  // by plane and side

/// Outward normals of the faces of a block in borders of the model.
std::vector<Vector3> border_normals(const Polyhedron& solid, const std::vector<ScenePlane>& borders) {
  std::vector<Vector3> normals;
  for (const ScenePlane& border : borders)
    for (const int face : faces_in_plane(solid, {border.point, border.normal})) {
      const auto& [a, b, c] = solid.mesh().triangles[at(solid.faces()[at(face)].triangles.front())];
      const auto point = [&](int k) { return solid.mesh().points[at(k)]; };
      normals.emplace_back((point(b) - point(a)).cross(point(c) - point(a)).normalized());
    }
  return normals;
}

bool has_free_face(const BlockReport& report, std::size_t index, const Holds& holds,
                   const std::vector<Vector3>& borders) {
  // Normals of both are rounded.
  constexpr double same_direction = 1.0 - 1e-9;
  const BlockSolid block = report.solid(index);
  std::map<std::pair<int, bool>, double> bare;
  for (const PieceFace& face : block.solid->faces(block.piece)) {
    const Vector3 normal = block.solid->normal(face);
    const bool at_border = std::any_of(borders.begin(), borders.end(), [&](const Vector3& border) {
      return border.dot(normal) > same_direction;
    });
    if (report.is_bare(index, face) && !at_border) bare[{face.plane, face.below}] += block.solid->area(face);
  }
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

/// Directions that the supports of a block bar, both ways of each axis.
std::vector<Vector3> barred_by_supports(const SceneBlock& block) {
  std::array<bool, 3> axes = {};
  for (const SceneFix& fix : block.fix)
    for (std::size_t axis = 0; axis < 3; ++axis) axes[axis] = axes[axis] || fix.components[axis];
  std::vector<Vector3> barred;
  for (int axis = 0; axis < 3; ++axis)
    if (axes[at(axis)])
      for (const double way : {1.0, -1.0}) barred.emplace_back(way * Vector3::Unit(axis));
  return barred;
}

/// Planes in which the model ends but the rock does not.
std::vector<ScenePlane> borders_of(const Scene& scene, std::vector<ScenePlane> borders) {
  for (const SceneBlock& block : scene.block)
    for (const SceneFix& fix : block.fix)
      if (const auto* plane = std::get_if<ScenePlane>(&fix.where)) borders.push_back(*plane);
  for (const SceneBoundary& boundary : scene.boundary) borders.push_back(boundary.plane);
  return borders;
}

double weight_of(const Scene& scene, std::size_t block, double volume) {
  for (const SceneMaterial& material : scene.material)
    if (material.name == scene.block[block].material)
      return material.density * volume * scene.analysis.gravity.norm();
  return 0.0;
}

/// Against the motion, for a factor. @param factor of the block
double needed_force(const KeyBlock& key, double factor, double weight, double wanted) {
  if (!key.removable || !(key.thrust > 0.0) || !(factor < wanted)) return 0.0;
  return weight * key.thrust * (1.0 - factor / wanted);
}

double factor_of(const KeyBlock& key, const std::vector<HeldFace>& held, const Holds& holds) {
  if (key.mode == BlockMode::falling) return 0.0;
  if (key.mode != BlockMode::sliding_on_one && key.mode != BlockMode::sliding_on_two)
    return std::numeric_limits<double>::infinity();
  double strength = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    // Supports have no friction.
    if (key.faces[k] < 0 || at(key.faces[k]) >= held.size()) continue;
    const HeldFace& face = held[static_cast<std::size_t>(key.faces[k])];
    const Hold& hold = holds.at({face.plane, face.below});
    strength += key.pressure[k] * hold.friction / hold.area;
  }
  return strength / key.thrust;
}

}  // namespace

std::vector<RemovableBlock> find_removable_blocks(const BlockReport& report, const RemovableSearch& search) {
  const Scene& scene = report.loaded().scene;
  const JointTable table(scene);
  const std::vector<ScenePlane> borders = borders_of(scene, search.borders);
  std::vector<RemovableBlock> result;
  for (std::size_t k = 0; k < scene.block.size(); ++k) {
    if (!report.is_there(k) || scene.block[k].fixed) continue;
    Holds holds;
    bool tied = false;
    for (const BlockBorder& border : report.blocks()[k].borders) {
      const SceneJointLaw law = table.law_between(k, border.block);
      tied = tied || law.tied || law.tie;
      Hold& hold = holds[{border.plane, border.below}];
      hold.area += border.area;
      hold.friction += border.area * correctly_rounded::tan_of_degrees(law.friction_angle);
    }
    const BlockSolid block = report.solid(k);
    if (tied || !has_free_face(report, k, holds, border_normals(report.loaded().solids[k], borders)))
      continue;
    std::vector<HeldFace> held;
    for (const auto& [plane, hold] : holds) held.push_back({plane.first, plane.second});
    const KeyBlock key =
        block.solid->key_block(block.piece, held, search.force, barred_by_supports(scene.block[k]));
    const double factor = factor_of(key, held, holds);
    const double weight = weight_of(scene, k, report.blocks()[k].volume);
    result.push_back({k, key, factor, weight, needed_force(key, factor, weight, search.wanted)});
  }
  return result;
}

}  // namespace ashlar
