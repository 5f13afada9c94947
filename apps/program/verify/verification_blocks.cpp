#include "apps/program/verify/verification_blocks.hpp"

namespace ashlar {

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
