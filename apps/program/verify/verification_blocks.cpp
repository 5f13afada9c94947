#include "apps/program/verify/verification_blocks.hpp"

#include <cmath>

#include "apps/program/verify/verification_values.hpp"

namespace ashlar {

namespace {

constexpr double thickness_of_plate = 0.1;  // m
const Material material_of_plate{2500.0, 1e9, 0.3};

}  // namespace

BlockDefinition clamped_plate(int order) {
  BlockDefinition block =
      define_block(Polyhedron(make_box({0, 0, 0}, {1, 1, thickness_of_plate})), material_of_plate, order);
  for (int axis = 0; axis < 2; ++axis)
    for (const double side : {0.0, 1.0})
      block.supports.push_back({Plane{side * Vector3::Unit(axis), Vector3::Unit(axis)}});
  return block;
}

double deflection_of_plate() {
  const double ratio = material_of_plate.poisson_ratio;
  const double rigidity =
      material_of_plate.young_modulus * std::pow(thickness_of_plate, 3) / (12.0 * (1.0 - ratio * ratio));
  return -0.0015046 * material_of_plate.density * earth_gravity * thickness_of_plate / rigidity;
}

Polyhedron notched_block() {
  TriangleMesh mesh;
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] : {std::pair{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})
      mesh.points.emplace_back(x, y, z);
  }
  for (int k = 1; k + 1 < 6; ++k) {
    mesh.triangles.push_back({0, k + 1, k});
    mesh.triangles.push_back({6, k + 6, k + 7});
  }
  for (int k = 0; k < 6; ++k) {
    const int next = (k + 1) % 6;
    mesh.triangles.push_back({k, next, next + 6});
    mesh.triangles.push_back({k, next + 6, k + 6});
  }
  return Polyhedron(std::move(mesh));
}

Polyhedron skew_hull() {
  const std::vector<Vector3> points = {{0, 0, 0},       {1.3, 0.1, -0.2}, {0.2, 1.1, 0.1},
                                       {1.0, 1.2, 0.3}, {0.3, 0.4, 1.4},  {0.9, 0.2, 0.8}};
  return Polyhedron(make_convex_hull(points));
}

}  // namespace ashlar
