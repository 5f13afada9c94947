#include "geometry/solid/hull_solid.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <random>

#include "geometry/solid/shapes.hpp"

namespace ashlar::hull_solid_test {
namespace {

/// Corners of a box, and points on its edges and faces.
std::vector<Vector3> box_points() {
  std::vector<Vector3> points;
  for (const double x : {0.0, 1.0, 3.0})
    for (const double y : {0.0, 0.7, 1.0})
      for (const double z : {0.0, 2.0}) points.emplace_back(x, y, z);
  return points;
}

TEST(HullSolid, OfTurnedPointsIsTheTurnedHull) {
  const Polyhedron straight = make_hull_solid(box_points(), 1e-14);
  EXPECT_EQ(straight.mesh().triangles, make_convex_hull(box_points()).triangles);
  std::mt19937 random(11);
  std::normal_distribution<double> part;
  for (int round = 0; round < 100; ++round) {
    const Eigen::Quaterniond rotation =
        Eigen::Quaterniond(part(random), part(random), part(random), part(random)).normalized();
    std::vector<Vector3> points = box_points();
    for (Vector3& point : points) point = rotation * point;
    const Polyhedron turned = make_hull_solid(points, 1e-14);
    ASSERT_EQ(turned.mesh().triangles, straight.mesh().triangles);
    EXPECT_EQ(turned.faces().size(), 6U);
    EXPECT_EQ(turned.edges().size(), 12U);
    EXPECT_TRUE(turned.convex());
    for (std::size_t k = 0; k < turned.mesh().points.size(); ++k)
      EXPECT_LT((turned.mesh().points[k] - rotation * straight.mesh().points[k]).norm(), 1e-15);
    for (std::size_t f = 0; f < 6; ++f) {
      EXPECT_EQ(turned.faces()[f].triangles, straight.faces()[f].triangles);
      EXPECT_EQ(turned.faces()[f].loops, straight.faces()[f].loops);
      EXPECT_TRUE(turned.faces()[f].convex);
      EXPECT_LT((turned.faces()[f].normal - rotation * straight.faces()[f].normal).norm(), 1e-14);
    }
  }
}

TEST(HullSolid, WithoutAResolutionIsExact) {
  // One unit in the last place above the corner of a square's plane.
  std::vector<Vector3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0x1p-53}, {0.5, 0.5, -1}};
  EXPECT_EQ(make_hull_solid(points, 0.0).faces().size(), 6U);
  EXPECT_EQ(make_hull_solid(points, 0x1p-52).faces().size(), 5U);
}

TEST(HullSolid, ThinnerThanTheResolutionIsStillASolid) {
  std::vector<Vector3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-15}};
  const Polyhedron solid = make_hull_solid(points, 1e-14);
  EXPECT_GT(solid.volume(), 0.0);
  EXPECT_EQ(solid.corners().size(), 4U);
  for (const PolyhedronFace& face : solid.faces()) {
    ASSERT_EQ(face.loops.size(), 1U);
    EXPECT_GE(face.loops[0].size(), 3U);
  }
}

}  // namespace
}  // namespace ashlar::hull_solid_test
