#include "apps/scene/assemble/quiet_boundaries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "apps/scene/assemble/block_material.hpp"
#include "apps/scene/expand/ground_layers.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

WaveVelocity velocity_of(const SceneBoundary& boundary) {
  WaveVelocity velocity;
  for (const auto& [time, value] : boundary.wave) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      velocity[axis].times.push_back(time);
      velocity[axis].values.push_back(value[static_cast<Eigen::Index>(axis)]);
    }
  }
  return velocity;
}

/// Component of a wave along a unit direction.
History component_of(const SceneBoundary& base, const Vector3& direction) {
  History history;
  for (const auto& [time, value] : base.wave) {
    history.times.push_back(time);
    history.values.push_back(direction.dot(value));
  }
  return history;
}

/// Three unit vectors at right angles, the first given.
std::array<Vector3, 3> frame_of(const Vector3& axis) {
  const Vector3 one = axis.unitOrthogonal();
  return {axis, one, axis.cross(one)};
}

/// Motion of a node over time; without rows: it never moves.
History history_of(const std::vector<double>& times, const std::vector<Eigen::MatrixX3d>& motion, int node,
                   int axis) {
  History history{times, {}};
  bool any = false;
  for (const Eigen::MatrixX3d& at_time : motion) {
    history.values.push_back(at_time(node, axis));
    any = any || history.values.back() != 0.0;
  }
  return any ? history : History{};
}

/// Layers of a column beside some faces, increasing.
std::vector<std::size_t> layers_at(const SideColumn& side, const Polyhedron& solid,
                                   const std::vector<int>& faces) {
  double bottom = std::numeric_limits<double>::infinity(), top = -bottom;
  for (const int face : faces)
    for (const int corner : solid.faces()[at(face)].loops.front()) {
      const double height = side.axis.dot(solid.mesh().points[at(corner)] - side.origin);
      bottom = std::min(bottom, height);
      top = std::max(top, height);
    }
  const double tolerance = allowed_offset(solid);
  std::vector<std::size_t> layers;
  for (std::size_t k = 0; k < side.column->layers().size(); ++k) {
    const GroundLayer& layer = side.column->layers()[k];
    if (layer.bottom < top - tolerance && layer.top > bottom + tolerance) layers.push_back(k);
  }
  return layers;
}

SideColumn side_of(const Scene& scene, std::size_t boundary, const std::vector<Polyhedron>& of_blocks,
                   const SimulationSettings& settings, Diagnostics& diagnostics) {
  SideColumn side;
  const auto base = base_of_side(scene, boundary);
  if (scene.boundary[boundary].kind != SceneBoundary::Kind::free_field || !base ||
      scene.boundary[*base].wave.empty() || is_static(scene.analysis))
    return side;
  std::vector<const Polyhedron*> solids;
  for (const Polyhedron& solid : of_blocks) solids.push_back(&solid);
  const SideLayers found = layers_beside(scene, boundary, *base, solids);
  if (!found.fault.empty()) {
    diagnostics.error(scene.places.value(fmt::format("boundary.{}.plane", boundary)),
                      fmt::format("free-field has no column of ground ({})", found.fault));
    return side;
  }
  std::vector<GroundLayer> layers;
  for (const auto& [bottom, top, block] : found.layers)
    layers.push_back({bottom, top, material_of(scene, block), scene.block[block].order});
  side.column = std::make_shared<const FreeFieldColumn>(std::move(layers));
  side.axis = -scene.boundary[*base].plane.normal.normalized();
  side.origin = scene.boundary[*base].plane.point;
  const auto nodes = static_cast<Eigen::Index>(side.column->nodes().size());
  bool along = true;
  for (const Vector3& direction : frame_of(side.axis)) {
    const ColumnMotion motion = side.column->motion(
        std::exchange(along, false) ? ColumnWave::along : ColumnWave::across,
        component_of(scene.boundary[*base], direction), settings, scene.analysis.end_time);
    side.times = motion.times;
    side.displacement.resize(side.times.size(), Eigen::MatrixX3d::Zero(nodes, 3));
    side.velocity.resize(side.times.size(), Eigen::MatrixX3d::Zero(nodes, 3));
    for (std::size_t n = 0; n < side.times.size(); ++n) {
      const auto column = static_cast<Eigen::Index>(n);
      side.displacement[n] += motion.displacement.col(column) * direction.transpose();
      side.velocity[n] += motion.velocity.col(column) * direction.transpose();
    }
  }
  return side;
}

/// Tractions of a column on faces of a block. @param material of the block
std::vector<Load> beside(const SideColumn& side, const Polyhedron& solid, const Material& material,
                         const std::vector<int>& faces) {
  const Vector3& normal = solid.faces()[at(faces.front())].normal;
  const Vector3& up = side.axis;
  const Eigen::Matrix3d resistance = impedance(material, normal);
  std::vector<Load> loads;
  for (const std::size_t layer : layers_at(side, solid, faces)) {
    const GroundLayer& ground = side.column->layers()[layer];
    // s n = stress * e
    const Eigen::Matrix3d stress =
        ground.material.lame_lambda() * normal * up.transpose() +
        ground.material.lame_mu() * (up.dot(normal) * Eigen::Matrix3d::Identity() + up * normal.transpose());
    for (int node = 0; node <= ground.order; ++node) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto add = [&](const std::vector<Eigen::MatrixX3d>& motion, const Vector3& traction,
                             bool of_slope) {
          History history = history_of(side.times, motion, side.column->first_node(layer) + node, axis);
          if (history.times.empty() || traction.isZero(0.0)) return;
          Load load{FaceList{faces}, true, Vector3::Zero(), std::move(history)};
          load.field = [column = side.column, up, origin = side.origin, layer, node, traction,
                        of_slope](const Vector3& place) -> Vector3 {
            const double height = up.dot(place - origin);
            if (column->layer_at(height) != layer) return Vector3::Zero();
            return (of_slope ? column->slopes(layer, height) : column->values(layer, height))[node] *
                   traction;
          };
          load.field_degree = ground.order;
          loads.push_back(std::move(load));
        };
        add(side.velocity, resistance.col(axis), false);
        add(side.displacement, stress.col(axis), true);
      }
    }
  }
  return loads;
}

}  // namespace

std::array<bool, 3> held_components(const Vector3& normal, const Vector3& gravity) {
  constexpr double across = 1e-9;  // cosine of a right angle, as written in decimals
  const Vector3 unit = normal.normalized();
  std::array<bool, 3> held = {true, true, true};
  if (gravity.isZero(0.0) || std::abs(unit.dot(gravity.normalized())) > across) return held;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(unit[axis]) < 1.0 - across) continue;
    held = {axis == 0, axis == 1, axis == 2};
  }
  return held;
}

QuietBoundaries::QuietBoundaries(const Scene& scene, const std::vector<Polyhedron>& solids,
                                 const SimulationSettings& settings, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < scene.boundary.size(); ++i)
    sides_.push_back(side_of(scene, i, solids, settings, diagnostics));
}

std::vector<QuietFaces> QuietBoundaries::of_block(const Scene& scene, const Polyhedron& solid,
                                                  std::size_t block) const {
  std::vector<QuietFaces> result;
  if (scene.block[block].fixed) return result;
  for (std::size_t i = 0; i < scene.boundary.size(); ++i) {
    const SceneBoundary& boundary = scene.boundary[i];
    const std::vector<int> faces = outer_faces(solid, {boundary.plane.point, boundary.plane.normal});
    if (faces.empty()) continue;
    const Material material = material_of(scene, block);
    result.push_back({.where = FaceList{faces},
                      .components = held_components(boundary.plane.normal, scene.analysis.gravity),
                      .driving = sides_[i].column != nullptr
                                     ? beside(sides_[i], solid, material, faces)
                                     : wave_loads(solid, faces, material, velocity_of(boundary))});
  }
  return result;
}

}  // namespace ashlar
