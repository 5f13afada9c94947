#include "solver/contact/reference_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/simulations.hpp"

namespace ashlar::reference_order_test {
namespace {

BlockModel cube_at(const Vector3& corner) {
  return BlockModel(test_support::block_of("cube", Polyhedron(make_box(corner, corner + Vector3::Ones())),
                                           {2500, 1e9, 0.2}, 1));
}

/// True if the block at one corner is before the one at the other, in both orders of the list.
std::vector<bool> is_before(const std::vector<Vector3>& corners, const Vector3& gravity, int a, int b) {
  std::vector<BlockModel> blocks;
  std::vector<BlockModel> reversed;
  for (const Vector3& corner : corners) blocks.push_back(cube_at(corner));
  for (auto corner = corners.rbegin(); corner != corners.rend(); ++corner)
    reversed.push_back(cube_at(*corner));
  const int last = static_cast<int>(corners.size()) - 1;
  return {ReferenceOrder(places_of(blocks), gravity).is_before(a, b),
          ReferenceOrder(places_of(reversed), gravity).is_before(last - a, last - b)};
}

const std::vector<bool> both = {true, true};
const std::vector<bool> neither = {false, false};

TEST(ReferenceOrder, TheHigherBlockIsFirst) {
  for (const double distance : {1.0, 1e-3}) {
    EXPECT_EQ(is_before({{0, 0, 0}, {0, 0, distance}}, {0, 0, -9.81}, 1, 0), both);
    EXPECT_EQ(is_before({{0, 0, 0}, {0, 0, distance}}, {0, 0, -9.81}, 0, 1), neither);
    EXPECT_EQ(is_before({{0, 0, 0}, {0, 0, distance}}, {0, 0, 1.62}, 0, 1), both) << "gravity upwards";
  }
}

TEST(ReferenceOrder, OfBlocksThatAreAsHighTheOneFarFromTheMiddleIs) {
  // Centroids at x = 0.5, 1.5 and 5.5: the middle is 2.5, from which they are 2, 1 and 3 m.
  const std::vector<Vector3> row = {{0, 0, 0}, {1, 0, 1e-12}, {5, 0, 0}};
  for (const Vector3& gravity : {Vector3(0, 0, -9.81), Vector3(0, 0, 0)}) {
    EXPECT_EQ(is_before(row, gravity, 0, 1), both);
    EXPECT_EQ(is_before(row, gravity, 2, 0), both);
    EXPECT_EQ(is_before(row, gravity, 1, 2), neither);
  }
}

TEST(ReferenceOrder, WhereNothingTellsOneOfTwoIs) {
  const std::vector<BlockModel> blocks = {cube_at({0, 0, 0}), cube_at({1, 0, 0})};
  const ReferenceOrder order(places_of(blocks), {0, 0, -9.81});
  EXPECT_TRUE(order.is_before(1, 0));
  EXPECT_FALSE(order.is_before(0, 1));
}

}  // namespace
}  // namespace ashlar::reference_order_test
