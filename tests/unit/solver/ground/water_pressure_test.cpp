#include "solver/ground/water_pressure.hpp"

#include <gtest/gtest.h>

#include "geometry/solid/shapes.hpp"
#include "geometry/terrain/height_field.hpp"

namespace ashlar::water_pressure_test {
namespace {

/// Two boxes of 2 x 1 x 3 m side by side, divided at x = 2.
class WaterPressureTest : public ::testing::Test {
 protected:
  const Polyhedron left{make_box({0, 0, 0}, {2, 1, 3})};
  const Polyhedron right{make_box({2, 0, 0}, {4, 1, 3})};
};

GroundWater water_up_to(double height) {
  return {WaterLevel(Plane{{0, 0, height}, Vector3::UnitZ()}, Vector3::UnitZ()), 1000.0};
}

/// Water in no joint.
GroundWater water_beside_joints(double height) {
  GroundWater water = water_up_to(height);
  water.joints = [](std::size_t, std::size_t) { return false; };
  return water;
}

/// Sum of the pressures on a block, N. @param direction of the pressures that count; zero: all
Vector3 force(const WaterPressure& water, std::size_t block, const Vector3& direction = Vector3::Zero()) {
  Vector3 sum = Vector3::Zero();
  for (const PressedPart& part : water.of_block(block).parts) {
    if (!direction.isZero(0.0) && part.direction.dot(direction) < 0.5) continue;
    const std::vector<Vector3>& x = part.pressure.corners;
    for (std::size_t k = 1; k + 1 < x.size(); ++k) {
      const double mean = (part.pressure.at(x[0]) + part.pressure.at(x[k]) + part.pressure.at(x[k + 1])) / 3;
      sum += 0.5 * (x[k] - x[0]).cross(x[k + 1] - x[0]).norm() * mean * part.direction;
    }
  }
  return sum;
}

// 2 m of water: 1/2 w h^2 = 2000 N/m on a side of 1 m, w h = 2000 Pa on the bottom of 2 m^2, which is the buoyancy.
TEST_F(WaterPressureTest, SubmergedFacesHaveTheWeightOfTheWaterAbove) {
  const WaterPressure water({water_up_to(2.0)}, {{&left}});
  EXPECT_NEAR(force(water, 0, -Vector3::UnitX()).x(), -2000.0, 1e-9);
  EXPECT_NEAR(force(water, 0, Vector3::UnitZ()).z(), 4000.0, 1e-9);
  EXPECT_LT((force(water, 0) - Vector3(0, 0, 4000)).norm(), 1e-9);
  EXPECT_TRUE(water.unknown_levels().empty());
}

TEST_F(WaterPressureTest, AJointHasItOnBothBlocks) {
  const WaterPressure water({water_up_to(2.0)}, {{&left}, {&right}});
  EXPECT_LT((force(water, 0) - Vector3(0, 0, 4000)).norm(), 1e-9);
  EXPECT_LT((force(water, 1) - Vector3(0, 0, 4000)).norm(), 1e-9);
  EXPECT_NEAR(water.in_joint(0, 1, {2, 0.5, 0.5}), 1500.0, 1e-9);
  EXPECT_EQ(water.in_joint(0, 1, {2, 0.5, 2.5}), 0.0);
}

TEST_F(WaterPressureTest, AFaceInADryJointIsNotFree) {
  const WaterPressure water({water_beside_joints(2.0)}, {{&left}, {&right}});
  EXPECT_LT((force(water, 0) - Vector3(2000, 0, 4000)).norm(), 1e-9);
  EXPECT_LT((force(water, 1) - Vector3(-2000, 0, 4000)).norm(), 1e-9);
  EXPECT_EQ(water.in_joint(0, 1, {2, 0.5, 0.5}), 0.0);
}

TEST_F(WaterPressureTest, AbsentBlocksHaveNoJointsAndFixedOnesNoLoads) {
  const GroundBlock absent{&right, false, false}, fixed{&right, true, true};
  const WaterPressure beside_nothing({water_beside_joints(2.0)}, {{&left}, absent});
  EXPECT_LT((force(beside_nothing, 0) - Vector3(0, 0, 4000)).norm(), 1e-9);
  EXPECT_TRUE(beside_nothing.of_block(1).parts.empty());
  const WaterPressure beside_fixed({water_beside_joints(2.0)}, {{&left}, fixed});
  EXPECT_LT((force(beside_fixed, 0) - Vector3(2000, 0, 4000)).norm(), 1e-9);
  EXPECT_TRUE(beside_fixed.of_block(1).parts.empty());
}

// The second water presses on the free faces of the right block only: 1 m instead of 2 m on its bottom.
TEST_F(WaterPressureTest, TheLastWaterCounts) {
  GroundWater low = water_beside_joints(1.0);
  low.faces = {false, true};
  const WaterPressure water({water_up_to(2.0), low}, {{&left}, {&right}});
  EXPECT_LT((force(water, 0) - Vector3(0, 0, 4000)).norm(), 1e-9);
  // From the joint 1/2 w 2^2 to the right, from the free side 1/2 w 1^2 to the left.
  EXPECT_LT((force(water, 1) - Vector3(2000 - 500, 0, 2000)).norm(), 1e-9);
  EXPECT_NEAR(water.in_joint(0, 1, {2, 0.5, 0.5}), 1500.0, 1e-9);
}

TEST_F(WaterPressureTest, ALevelThatEndsOverABlockIsReported) {
  const WaterLevel level(height_field({{0, 0, 2}, {1, 0, 2}, {0, 1, 2}, {1, 1, 2}}));
  const WaterPressure water({{level, 1000.0}}, {{&left}});
  ASSERT_EQ(water.unknown_levels().size(), 1U);
  EXPECT_EQ(water.unknown_levels()[0].water, 0U);
  EXPECT_EQ(water.unknown_levels()[0].block, 0U);
  EXPECT_EQ(water.unknown_levels()[0].place.x(), 2.0);
}

}  // namespace
}  // namespace ashlar::water_pressure_test
