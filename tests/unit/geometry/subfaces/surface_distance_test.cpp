#include "geometry/subfaces/surface_distance.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/solid/shapes.hpp"

namespace ashlar::surface_distance_test {
namespace {

/// A lower bound of the distance of two boxes, both turned.
double bound(const TriangleMesh& a, const TriangleMesh& b, const Eigen::Matrix3d& turn) {
  const auto surface_of = [](const TriangleMesh& mesh) { return whole_surface(Polyhedron(mesh)); };
  const auto turned = [&](const TriangleMesh& mesh) {
    std::vector<Vector3> points;
    for (const Vector3& point : mesh.points) points.emplace_back(turn * point);
    return points;
  };
  const SubFaceSurface surface_a = surface_of(a), surface_b = surface_of(b);
  return least_distance(PlacedSurface(surface_a, turned(a)), PlacedSurface(surface_b, turned(b)));
}

const Eigen::Matrix3d as_is = Eigen::Matrix3d::Identity();
const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Vector3(1, 1, 2).normalized()).toRotationMatrix();

TEST(SurfaceDistance, OfFacesThatAreOppositeIsTheirs) {
  const TriangleMesh a = make_box({0, 0, 0}, {1, 1, 1}), b = make_box({0.25, 0, 1.5}, {1, 1, 2});
  for (const Eigen::Matrix3d& by : {as_is, turn}) {
    EXPECT_LE(bound(a, b, by), 0.5);
    EXPECT_NEAR(bound(a, b, by), 0.5, 1e-13);
  }
}

TEST(SurfaceDistance, IsNeverMoreThanTheTrueOne) {
  // Corner to corner: sqrt(3)/2; the line between the middles goes through both corners.
  const TriangleMesh a = make_box({0, 0, 0}, {1, 1, 1}), b = make_box({1.5, 1.5, 1.5}, {2.5, 2.5, 2.5});
  for (const Eigen::Matrix3d& by : {as_is, turn}) {
    EXPECT_LE(bound(a, b, by), std::sqrt(0.75));
    EXPECT_NEAR(bound(a, b, by), std::sqrt(0.75), 1e-13);
  }
}

TEST(SurfaceDistance, OfASphereWithManyCellsIsThatOfTheNearestOnes) {
  // 1280 triangles. The lower face of the box is above the highest point of the sphere.
  const TriangleMesh sphere = make_sphere({0, 0, 0}, 1.0, 3);
  double top = 0.0;
  for (const Vector3& point : sphere.points) top = std::max(top, point.z());
  for (const double gap : {1e-3, 0.02, 0.2}) {
    const TriangleMesh box = make_box({-0.3, -0.3, top + gap}, {0.3, 0.3, top + gap + 0.3});
    for (const Eigen::Matrix3d& by : {as_is, turn}) {
      EXPECT_LE(bound(sphere, box, by), gap * (1.0 + 1e-12));
      EXPECT_GT(bound(sphere, box, by), 0.9 * gap);
      EXPECT_EQ(bound(sphere, box, by), bound(box, sphere, by));
    }
  }
}

TEST(SurfaceDistance, OfAStoneInAHollowIsFromItsWalls) {
  // No plane lies between a stone and a hollow around it.
  const TriangleMesh stone = make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  const TriangleMesh hollow = make_sphere({0, 0, 0}, 2.0, 3);
  // Its walls are farther away than half of its size, the diagonal: a triangle of the sphere is at most 2 % nearer than 2 m,
  // 1.09 m from a corner. That half is told.
  for (const Eigen::Matrix3d& by : {as_is, turn})
    EXPECT_NEAR(bound(hollow, stone, by), 0.5 * std::sqrt(3.0), 1e-12);
}

TEST(SurfaceDistance, OfASphereThatIsCutIsNone) {
  const TriangleMesh sphere = make_sphere({0, 0, 0}, 1.0, 3);
  EXPECT_EQ(bound(sphere, make_box({-0.2, -0.2, 0.9}, {0.2, 0.2, 1.2}), turn), 0.0);
}

TEST(SurfaceDistance, OfSurfacesThatMeetIsNone) {
  const TriangleMesh a = make_box({0, 0, 0}, {1, 1, 1}), b = make_box({0.5, 0.5, 0.5}, {2, 2, 2});
  EXPECT_EQ(bound(a, b, as_is), 0.0);
  EXPECT_EQ(bound(a, b, turn), 0.0);
  EXPECT_EQ(bound(a, make_box({1, 0, 0}, {2, 1, 1}), as_is), 0.0) << "they touch";
}

}  // namespace
}  // namespace ashlar::surface_distance_test
