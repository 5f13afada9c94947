#include "geometry/cutting/cut_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ashlar::cut_plane_test {
namespace {

TEST(CutPlane, MultiplesOf90DegreesAreExact) {
  EXPECT_EQ(plane_normal(0, 0), Vector3::UnitZ());
  EXPECT_EQ(plane_normal(0, 90), Vector3::UnitZ());
  EXPECT_EQ(plane_normal(90, 0), Vector3::UnitY());
  EXPECT_EQ(plane_normal(90, 90), Vector3::UnitX());
  EXPECT_EQ(plane_normal(90, 180), -Vector3::UnitY());
  EXPECT_EQ(plane_normal(90, -90), -Vector3::UnitX());
  EXPECT_EQ(plane_normal(90, 720 + 90), Vector3::UnitX());
}

// So that a plane of 45 degrees goes through two edges of a box exactly.
TEST(CutPlane, ComponentsOf45DegreesAreEqual) {
  EXPECT_EQ(plane_normal(45, 90).x(), plane_normal(45, 90).z());
  EXPECT_EQ(plane_normal(90, 315).x(), -plane_normal(90, 315).y());
  EXPECT_EQ(plane_normal(45, 90).x(), std::sqrt(0.5));
}

// A plane that dips to the south-east: a step down the dip lowers z by the tangent of the dip.
TEST(CutPlane, DipsTowardsTheDipDirection) {
  const double degree = std::acos(-1.0) / 180.0;
  const Vector3 normal = plane_normal(30, 120);
  const Vector3 down(std::sin(120 * degree), std::cos(120 * degree), -std::tan(30 * degree));
  EXPECT_NEAR(normal.dot(down), 0.0, 1e-15);
  EXPECT_NEAR(normal.norm(), 1.0, 1e-15);
  EXPECT_GT(normal.z(), 0.0);
}

}  // namespace
}  // namespace ashlar::cut_plane_test
