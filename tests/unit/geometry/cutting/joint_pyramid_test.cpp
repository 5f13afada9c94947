#include "geometry/cutting/joint_pyramid.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ashlar::joint_pyramid_test {
namespace {

IntegerVector vector(long x, long y, long z) {
  return {Integer(x), Integer(y), Integer(z)};
}

const IntegerVector down_face = vector(0, 0, -1), up_face = vector(0, 0, 1);
const std::vector<IntegerVector> sides = {vector(1, 0, 0), vector(-1, 0, 0), vector(0, 1, 0),
                                          vector(0, -1, 0)};

TEST(JointPyramid, OfABoxIsEmptyOnlyIfAllSidesHold) {
  std::vector<IntegerVector> held = sides;
  held.push_back(down_face);
  EXPECT_TRUE(has_direction(held));  // up alone
  held.push_back(up_face);
  EXPECT_FALSE(has_direction(held));
  EXPECT_TRUE(has_direction({}));
  EXPECT_TRUE(has_direction({down_face, up_face}));
}

TEST(JointPyramid, BoxOnAFloor) {
  const KeyBlock block = find_key_block({down_face}, sides, {0, 0, -1});
  EXPECT_TRUE(block.removable);
  EXPECT_EQ(block.mode, BlockMode::stable);
  EXPECT_FALSE(block.finite) << "without a top the prism is infinite";
}

// A force of 30 degrees off the normal of the floor: pressure cos 30, thrust sin 30.
TEST(JointPyramid, SlidesOnOneFace) {
  const double degree = std::acos(-1.0) / 180.0;
  const Vector3 force(std::sin(30 * degree), 0, -std::cos(30 * degree));
  const KeyBlock block = find_key_block({down_face}, {up_face}, force);
  EXPECT_EQ(block.mode, BlockMode::sliding_on_one);
  EXPECT_EQ(block.faces[0], 0);
  EXPECT_NEAR(block.pressure[0], std::cos(30 * degree), 1e-15);
  EXPECT_NEAR(block.thrust, 0.5, 1e-15);
  EXPECT_EQ(block.direction, Vector3::UnitX());
  // A wall in the way leaves nothing but to stay.
  EXPECT_EQ(find_key_block({down_face, vector(1, 0, 0)}, {}, force).mode, BlockMode::stable);
  // A wall at 45 degrees turns it aside: along (0, -1, 0) + ..., the line of both.
  const KeyBlock turned = find_key_block({down_face, vector(1, 1, 0)}, {}, force);
  EXPECT_EQ(turned.mode, BlockMode::sliding_on_two);
  EXPECT_NEAR(turned.direction.x(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(turned.direction.y(), -std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(turned.thrust, 0.5 * std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(turned.pressure[1], 0.5 * std::sqrt(0.5), 1e-15);
}

TEST(JointPyramid, FallsOffARoofAndLiftsOffAFloor) {
  EXPECT_EQ(find_key_block({up_face}, {down_face}, {0, 0, -1}).mode, BlockMode::falling);
  EXPECT_EQ(find_key_block({down_face}, {up_face}, {0, 0, 1}).mode, BlockMode::falling);
  // Along a wall without pressure.
  const KeyBlock block = find_key_block({vector(1, 0, 0)}, {}, {0, 0, -1});
  EXPECT_EQ(block.mode, BlockMode::falling);
  EXPECT_EQ(block.direction, -Vector3::UnitZ());
}

TEST(JointPyramid, ModesHaveNames) {
  EXPECT_STREQ(to_string(BlockMode::not_removable), "not removable");
  EXPECT_STREQ(to_string(BlockMode::stable), "stable");
  EXPECT_STREQ(to_string(BlockMode::falling), "falling");
  EXPECT_STREQ(to_string(BlockMode::sliding_on_one), "sliding on one face");
  EXPECT_STREQ(to_string(BlockMode::sliding_on_two), "sliding on two faces");
}

}  // namespace
}  // namespace ashlar::joint_pyramid_test
