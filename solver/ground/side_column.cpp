#include "solver/ground/side_column.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

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

}  // namespace

SideColumn side_column(const Plane& base, std::vector<GroundLayer> layers, const GroundWave& wave,
                       const SimulationSettings& settings, double end_time) {
  SideColumn side;
  side.column = std::make_shared<const FreeFieldColumn>(std::move(layers));
  side.axis = -base.normal.normalized();
  side.origin = base.point;
  const auto nodes = static_cast<Eigen::Index>(side.column->nodes().size());
  bool along = true;
  for (const Vector3& direction : frame_of(side.axis)) {
    const ColumnMotion motion =
        side.column->motion(std::exchange(along, false) ? ColumnWave::along : ColumnWave::across,
                            component_along(wave, direction), settings, end_time);
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

std::vector<Load> column_loads(const SideColumn& side, const Polyhedron& solid, const Material& material,
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

}  // namespace ashlar
