#include "geometry/exact/degree_turn.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace ashlar::degree_turn_test {
namespace {

TEST(DegreeTurn, QuarterAndEighthTurns) {
  const std::array<double, 4> sines = {0, 1, 0, -1}, cosines = {1, 0, -1, 0};
  for (int k = -8; k < 8; ++k) {
    const auto quarter = static_cast<std::size_t>(k & 3);
    const DegreeTurn right = degree_turn(90.0 * k);
    EXPECT_EQ(right.sine, sines[quarter]) << k;
    EXPECT_EQ(right.cosine, cosines[quarter]) << k;
    const DegreeTurn half = degree_turn(90.0 * k + 45.0);
    EXPECT_EQ(std::abs(half.sine), std::sqrt(0.5)) << k;
    EXPECT_EQ(std::abs(half.cosine), std::sqrt(0.5)) << k;
  }
}

TEST(DegreeTurn, DirectionsHaveTheirAngles) {
  for (int degrees = -179; degrees <= 180; ++degrees) {
    const DegreeTurn turn = degree_turn(degrees);
    EXPECT_NEAR(degrees_of(turn.cosine, turn.sine), degrees, 1e-13);
  }
  EXPECT_EQ(degrees_of(-3.0, -0.0), 180.0);
  EXPECT_EQ(degrees_of(3.0, -0.0), 0.0);
  EXPECT_EQ(degrees_of(0.0, 0.0), 0.0);
  EXPECT_EQ(degrees_of(0.0, -2.0), -90.0);
  EXPECT_EQ(degrees_of(-2.0, 2.0), 135.0);
}

}  // namespace
}  // namespace ashlar::degree_turn_test
