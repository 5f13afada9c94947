// Blocks and small measurements that verification cases share.
#pragma once

#include <memory>

#include "geometry/solid/shapes.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

[[nodiscard]] inline BlockDefinition define_block(Polyhedron solid, const Material& material, int order) {
  BlockDefinition definition;
  definition.name = "block";
  definition.solid = std::make_shared<const Polyhedron>(std::move(solid));
  definition.material = material;
  definition.order = order;
  return definition;
}

/// One block without contacts.
[[nodiscard]] inline Simulation lone_block(BlockDefinition definition, const InitialMotion& motion,
                                           const SimulationSettings& settings) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(definition));
  return {std::move(blocks), {motion}, [](int, int) { return JointLaw{}; }, settings};
}

/// A square plate of 1 m clamped at four sides, of a tenth in thickness; it has no motion of an order below 4.
[[nodiscard]] BlockDefinition clamped_plate(int order);
inline const Vector3 middle_of_plate(0.5, 0.5, 0.05);
/// Of its middle under its weight, m, upwards. Mindlin's theory, w = 0.0015046 q a^4 / D: the solid is 3 % stiffer, as its
/// clamped sides do not warp.
[[nodiscard]] double deflection_of_plate();

/// A non-convex solid: the box 2 x 2 x 1 with a notch 1 x 1 x 1 at its corner (2, 2).
[[nodiscard]] Polyhedron notched_block();

/// A convex solid without symmetry.
[[nodiscard]] Polyhedron skew_hull();

/// Displacement of a material point.
[[nodiscard]] inline Vector3 displacement(const BlockModel& block, const Eigen::MatrixX3d& position,
                                          const Vector3& point) {
  return (position - block.basis().identity_map()).transpose() * block.basis().values(point);
}

}  // namespace ashlar
