#include "mechanics/supports/water_level.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ashlar::water_level_test {
namespace {

/// Integral of the depth over parts, m^3: the mean of the corners of each triangle of a fan.
double volume(const std::vector<LinearPatch>& parts) {
  double sum = 0.0;
  for (const LinearPatch& part : parts)
    for (std::size_t k = 1; k + 1 < part.corners.size(); ++k) {
      const Vector3 u = part.corners[k] - part.corners[0], v = part.corners[k + 1] - part.corners[0];
      sum += 0.5 * u.cross(v).norm() *
             (part.at(part.corners[0]) + part.at(part.corners[k]) + part.at(part.corners[k + 1])) / 3.0;
    }
  return sum;
}

TEST(WaterLevel, PressesOnAWallAsATriangle) {
  const WaterLevel level(Plane{{0, 0, 2}, Vector3::UnitZ()}, Vector3::UnitZ());
  // A wall of 3 m, 5 m wide: 1/2 h^2 w below 2 m.
  EXPECT_NEAR(volume(level.below({{1, 0, 0}, {1, 5, 0}, {1, 5, 3}, {1, 0, 3}})), 0.5 * 4 * 5, 1e-12);
  EXPECT_TRUE(level.below({{1, 0, 2.5}, {1, 5, 2.5}, {1, 0, 3}}).empty());
  EXPECT_NEAR(level.depth({7, 7, -1}).value(), 3.0, 1e-15);
}

// From 4 m at x = 0 to nothing at x = 8: half the length times the largest, whatever the slope of the joint.
TEST(WaterLevel, AnInclinedLevelIsPiezometric) {
  const WaterLevel level(Plane{{0, 0, 4}, {4, 0, 8}}, Vector3::UnitZ());
  EXPECT_NEAR(volume(level.below({{0, 0, 0}, {8, 0, 0}, {8, 1, 0}, {0, 1, 0}})), 0.5 * 4 * 8, 1e-12);
}

TEST(WaterLevel, UpIsAgainstGravity) {
  const WaterLevel level(Plane{{0, 3, 0}, Vector3::UnitY()}, -Vector3::UnitY());
  EXPECT_NEAR(level.depth({0, 5, 0}).value(), 2.0, 1e-15);
  EXPECT_THROW(WaterLevel(Plane{{0, 0, 0}, Vector3::UnitX()}, Vector3::UnitY()), std::invalid_argument);
}

/// A roof: 2 m at the ridge y = 0, 1 m at y = 1 and y = -1.
WaterLevel roof() {
  return WaterLevel(height_field({{0, 0, 2}, {4, 0, 2}, {0, 1, 1}, {4, 1, 1}, {0, -1, 1}, {4, -1, 1}}));
}

TEST(WaterLevel, ASurfaceFromPointsIsLinearBetweenThem) {
  EXPECT_NEAR(roof().depth({2, 0.5, 0}).value(), 1.5, 1e-12);
  EXPECT_NEAR(roof().depth({2, -0.25, 3}).value(), -1.25, 1e-12);
  EXPECT_FALSE(roof().depth({5, 0, 0}).has_value());
  // A floor below all of it: mean height 1.5 over 8 m^2.
  EXPECT_NEAR(volume(roof().below({{0, -1, 0}, {4, -1, 0}, {4, 1, 0}, {0, 1, 0}})), 12.0, 1e-11);
}

// Below the ridge both triangles have the whole of a vertical joint on their sides: it counts once.
TEST(WaterLevel, AVerticalJointOnASideOfTwoTrianglesCountsOnce) {
  EXPECT_NEAR(volume(roof().below({{1, 0, 0}, {3, 0, 0}, {3, 0, 1}, {1, 0, 1}})), 2 * 1.5, 1e-11);
  // On the border there is only one.
  EXPECT_NEAR(volume(roof().below({{1, 1, 0}, {3, 1, 0}, {3, 1, 1}, {1, 1, 1}})), 2 * 0.5, 1e-11);
  // Across all of it: mean height 1.5, half of its square to be integrated: 2 * (1/3 + ...) by hand:
  // 2 * integral over y from 0 to 1 of 1/2 (2 - y)^2 = 2 * (8 - 1) / 6.
  EXPECT_NEAR(volume(roof().below({{2, -1, 0}, {2, 1, 0}, {2, 1, 2}, {2, -1, 2}})), 7.0 / 3.0, 1e-11);
}

}  // namespace
}  // namespace ashlar::water_level_test
