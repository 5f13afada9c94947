#include "apps/program/verify/placement.hpp"

#include <Eigen/Geometry>
#include <stdexcept>
#include <variant>

namespace ashlar {
namespace {

BlockPlace placed(const BlockPlace& where, const Placement& placement) {
  if (const auto* plane = std::get_if<Plane>(&where))
    return Plane{placement.point(plane->point), placement.direction(plane->normal)};
  if (const auto* point = std::get_if<Vector3>(&where)) return placement.point(*point);
  return where;
}

}  // namespace

Placement some_placement() {
  return {Eigen::AngleAxisd(0.8, Vector3(1, 2, 3).normalized()).toRotationMatrix(), {12, -30, 5}};
}

Polyhedron placed(const Polyhedron& solid, const Placement& placement) {
  std::vector<Vector3> points;
  for (const Vector3& point : solid.mesh().points) points.push_back(placement.point(point));
  return solid.with_points(std::move(points));
}

BlockDefinition placed(BlockDefinition block, const Placement& placement) {
  block.solid = std::make_shared<const Polyhedron>(placed(*block.solid, placement));
  block.shape = nullptr;
  const bool turned = placement.turn != Eigen::Matrix3d::Identity();
  for (BlockSupport& support : block.supports) {
    if (turned && support.components != std::array<bool, 3>{true, true, true})
      throw std::invalid_argument("a support of some components cannot be turned");
    support.where = placed(support.where, placement);
    for (Vector3& value : support.history.values) value = placement.direction(value);
  }
  for (Load& load : block.loads) {
    load.where = placed(load.where, placement);
    load.vector = placement.direction(load.vector);
  }
  for (Vector3& point : block.followed) point = placement.point(point);
  return block;
}

InitialMotion placed(const InitialMotion& motion, const Placement& placement) {
  return {placement.direction(motion.velocity), placement.direction(motion.angular_velocity)};
}

}  // namespace ashlar
