#include "geometry/solid/hull_surface.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>
#include <stdexcept>

#include "geometry/solid/shapes.hpp"

namespace ashlar::hull_surface_test {
namespace {

TEST(HullSurface, GroupsTheTrianglesOfABox) {
  const TriangleMesh mesh = make_box({0, 0, 0}, {1, 2, 3});
  const HullSurface surface(mesh.points, mesh.triangles, true);
  std::set<int> groups;
  for (int t = 0; t < 12; ++t) groups.insert(surface.group(t));
  EXPECT_EQ(groups.size(), 6U);
  for (const int count : surface.group_counts()) EXPECT_EQ(count, 3);
  FacetBoundaries boundaries(surface);
  for (const int group : groups) {
    const std::vector<int> loop = boundaries.loop(group);
    ASSERT_EQ(loop.size(), 4U);
    for (const int v : loop) EXPECT_GE(v, loop[0]);
    const Vector3 n =
        (mesh.points[loop[1]] - mesh.points[loop[0]]).cross(mesh.points[loop[2]] - mesh.points[loop[1]]);
    EXPECT_GT(n.dot(mesh.points[loop[0]] - Vector3(0.5, 1.0, 1.5)), 0.0);  // outward
  }
}

// A corner of the top is lowered by an ulp: the diagonal that reaches it is concave.
TEST(HullSurface, FlipsWhatRoundingMadeConcave) {
  for (const bool floating : {true, false}) {
    TriangleMesh mesh;
    for (int k = 0; k < 8; ++k) mesh.points.emplace_back(k & 1, k >> 1 & 1, k >> 2 & 1);
    mesh.points[7][2] = std::nextafter(1.0, 0.0);
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    const HullSurface surface(mesh.points, mesh.triangles, floating);
    // Point 7 is below the plane of 4, 5 and 6, so the hull has the edge 5-6 and not 4-7.
    std::set<std::pair<int, int>> edges;
    for (const auto& t : surface.triangles())
      for (int k = 0; k < 3; ++k) edges.insert({t[k], t[(k + 1) % 3]});
    EXPECT_TRUE(edges.contains({5, 6}) && edges.contains({6, 5}));
    EXPECT_FALSE(edges.contains({4, 7}) || edges.contains({7, 4}));
  }
}

TEST(HullSurface, RefusesAnOpenMesh) {
  TriangleMesh mesh = make_box({0, 0, 0}, {1, 1, 1});
  mesh.triangles.pop_back();
  EXPECT_THROW(HullSurface(mesh.points, mesh.triangles, true), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::hull_surface_test
