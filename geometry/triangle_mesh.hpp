// Plain surface data that crosses every border of the program: points and outward triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace ashlar {

using Vector3 = Eigen::Vector3d;

/// A surface made of triangles. Nothing is promised about it; see Polyhedron for a checked solid.
struct TriangleMesh {
  std::vector<Vector3> points;  ///< (#points), m
  std::vector<std::array<int, 3>>
      triangles;  ///< (#triangles), indices into points, counter-clockwise from outside
};

}  // namespace ashlar
