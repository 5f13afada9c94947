#include "mechanics/supports/gravity_history.hpp"

#include <gtest/gtest.h>

namespace ashlar::gravity_history_test {
namespace {

// A table that is tilted from 1 s to 3 s.
const GravityHistory tilt{{1.0, 3.0}, {{0, 0, -10}, {6, 0, -8}}};

TEST(GravityHistory, IsLinearBetweenRowsAndConstantOutside) {
  EXPECT_EQ(tilt.at(-5.0), Vector3(0, 0, -10));
  EXPECT_EQ(tilt.at(1.0), Vector3(0, 0, -10));
  EXPECT_EQ(tilt.at(1.5), Vector3(1.5, 0, -9.5));
  EXPECT_EQ(tilt.at(3.0), Vector3(6, 0, -8));
  EXPECT_EQ(tilt.at(7.0), Vector3(6, 0, -8));
}

TEST(GravityHistory, ChangesOnlyBetweenItsRows) {
  EXPECT_FALSE(tilt.changes_between(0.0, 1.0));
  EXPECT_TRUE(tilt.changes_between(0.0, 1.5));
  EXPECT_TRUE(tilt.changes_between(2.0, 9.0));
  EXPECT_FALSE(tilt.changes_between(3.0, 9.0));
  EXPECT_FALSE(GravityHistory{}.changes_between(0.0, 1.0));
}

TEST(GravityHistory, LargestIsThatOfARow) {
  EXPECT_EQ((GravityHistory{{0.0, 1.0, 2.0}, {{0, 0, -1}, {3, 0, -4}, {0, 0, 0}}}).largest(), 5.0);
  EXPECT_EQ(GravityHistory{}.largest(), 0.0);
}

}  // namespace
}  // namespace ashlar::gravity_history_test
