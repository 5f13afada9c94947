// Solids that tests of every layer share, and a quadrature over them that is independent of the program's own
// moments.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "geometry/solid/polyhedron.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar::test_support {

/// L-shaped prism: [0,2]x[0,1] and [0,1]x[1,2] in the plane, z from 0 to 1. Volume 3.
inline Polyhedron l_shaped_prism() {
  const std::vector<std::array<double, 2>> outline = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const std::vector<std::array<int, 3>> cap = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  TriangleMesh mesh;
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] : outline) mesh.points.emplace_back(x, y, z);
  }
  for (const auto& [a, b, c] : cap) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + 6, b + 6, c + 6});
  }
  for (int k = 0; k < 6; ++k) {
    const int next = (k + 1) % 6;
    mesh.triangles.push_back({k, next, next + 6});
    mesh.triangles.push_back({k, next + 6, k + 6});
  }
  return Polyhedron(std::move(mesh));
}

/// Named solids: box, tetrahedron, hull of five points, L-shaped prism, thin plate, far box.
inline std::vector<std::pair<std::string, Polyhedron>> sample_solids() {
  std::vector<std::pair<std::string, Polyhedron>> solids;
  solids.emplace_back("box", Polyhedron(make_box({-1, -2, -0.5}, {3, 1, 0.5})));
  solids.emplace_back("tetrahedron", Polyhedron(make_convex_hull(std::vector<Vector3>{
                                         {0, 0, 0}, {1, 0.1, 0}, {0.2, 1.3, 0}, {0.3, 0.2, 0.9}})));
  solids.emplace_back("hull", Polyhedron(make_convex_hull(std::vector<Vector3>{
                                  {0, 0, 0}, {1, 0, 0.1}, {0.2, 1, 0}, {0.3, 0.2, 1.5}, {0.4, 0.5, -0.8}})));
  solids.emplace_back("L", l_shaped_prism());
  solids.emplace_back("plate", Polyhedron(make_box({0, 0, 0}, {4, 4, 0.01})));
  solids.emplace_back("far box", Polyhedron(make_box({1000, 1000, 1000}, {1001, 1002, 1003})));
  return solids;
}

/// Gauss-Legendre points and weights on [0, 1] by Newton's method on the Legendre polynomial.
inline std::vector<std::pair<double, double>> gauss_rule(int count) {
  std::vector<std::pair<double, double>> rule;
  for (int k = 0; k < count; ++k) {
    double x = std::cos(3.14159265358979323846 * (k + 0.75) / (count + 0.5));
    double slope = 1.0;
    for (int iteration = 0; iteration < 60; ++iteration) {
      double previous = 1.0;
      double value = x;
      for (int m = 1; m < count; ++m) {
        const double next = ((2 * m + 1) * x * value - m * previous) / (m + 1);
        previous = value;
        value = next;
      }
      slope = count * (previous - x * value) / (1 - x * x);
      x -= value / slope;
    }
    rule.emplace_back(0.5 * (1 + x), 1.0 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

/// Points and weights that integrate polynomials of a degree over a solid: signed tetrahedra from its first
/// point, each mapped from the cube (Duffy).
inline std::vector<std::pair<Vector3, double>> volume_rule(const Polyhedron& solid, int degree) {
  const auto line = gauss_rule(degree / 2 + 3);
  std::vector<std::pair<Vector3, double>> rule;
  const auto& mesh = solid.mesh();
  const Vector3 apex = mesh.points.front();
  for (const auto& t : mesh.triangles) {
    const Vector3 a = mesh.points[static_cast<std::size_t>(t[0])] - apex;
    const Vector3 b = mesh.points[static_cast<std::size_t>(t[1])] - apex;
    const Vector3 c = mesh.points[static_cast<std::size_t>(t[2])] - apex;
    const double determinant = a.dot(b.cross(c));
    if (determinant == 0.0) continue;
    for (const auto& [u, wu] : line) {
      for (const auto& [v, wv] : line) {
        for (const auto& [w, ww] : line) {
          // apex + u (a + v (b - a) + v w (c - b)), Jacobian u^2 v
          rule.emplace_back(apex + u * (a + v * (b - a) + v * w * (c - b)),
                            determinant * u * u * v * wu * wv * ww);
        }
      }
    }
  }
  return rule;
}

}  // namespace ashlar::test_support
