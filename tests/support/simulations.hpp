// Small simulations that tests of mechanics and solver share.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/solid/shapes.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar::test_support {

inline BlockDefinition block_of(const std::string& name, Polyhedron solid, Material material, int order) {
  BlockDefinition definition;
  definition.name = name;
  definition.solid = std::make_shared<const Polyhedron>(std::move(solid));
  definition.material = material;
  definition.order = order;
  return definition;
}

/// A box that nothing moves.
inline BlockDefinition fixed_box(const Vector3& low, const Vector3& high) {
  BlockDefinition block = block_of("base", Polyhedron(make_box(low, high)), {2500, 1e9, 0.2}, 1);
  block.fixed = true;
  return block;
}

/// @param middle that stays where it is
inline Polyhedron turned(const Polyhedron& solid, const Eigen::AngleAxisd& turn,
                         const Vector3& middle = Vector3::Zero()) {
  std::vector<Vector3> points;
  for (const Vector3& point : solid.mesh().points) points.emplace_back(turn * (point - middle) + middle);
  return solid.with_points(std::move(points));
}

/// Box turned about the y axis through the origin, positive angles lifting the +x end.
inline Polyhedron tilted_box(const Vector3& low, const Vector3& high, double degrees) {
  const double angle = -degrees * std::numbers::pi / 180.0;
  return turned(Polyhedron(make_box(low, high)), Eigen::AngleAxisd(angle, Vector3::UnitY()));
}

inline Simulation::LawOfPair same_law(const JointLaw& law) {
  return [law](int, int) { return law; };
}

/// Runs to a time; false if a step could not be taken.
inline bool run_until(Simulation& simulation, double time) {
  while (!simulation.reached(time)) {
    if (simulation.step(time) != StepStatus::accepted) return false;
  }
  return true;
}

/// A static analysis to its end.
inline StaticStatus run_static(Simulation& simulation, double end_time) {
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing) status = simulation.static_step(end_time);
  return status;
}

/// Current position of a material point.
inline Vector3 place_of(const Simulation& simulation, int block, const Vector3& point) {
  const auto index = static_cast<std::size_t>(block);
  return simulation.states()[index].position.transpose() * simulation.blocks()[index].basis().values(point);
}

}  // namespace ashlar::test_support
