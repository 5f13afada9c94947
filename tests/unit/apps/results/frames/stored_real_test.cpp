#include "apps/results/frames/stored_real.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace ashlar::stored_real_test {
namespace {

using testing::ElementsAre;

TEST(StoredReal, IsTheNearestOfSinglePrecision) {
  EXPECT_EQ(to_float32(0.1), 0.1F);
  // Single precision has 24 bits: 1 + 2^-24 lies between two numbers, the even one is 1.
  EXPECT_EQ(to_float32(1.0 + std::ldexp(1.0, -24)), 1.0F);
  EXPECT_EQ(to_float32(1.0 + std::ldexp(3.0, -24)), 1.0F + std::ldexp(1.0F, -22));
  EXPECT_EQ(to_float32(std::ldexp(1.0, -149)), std::numeric_limits<float>::denorm_min());
  EXPECT_EQ(to_float32(1e-46), 0.0F);
  EXPECT_TRUE(std::signbit(to_float32(-0.0)));
}

TEST(StoredReal, BeyondTheRangeIsTheLargestNumber) {
  constexpr float largest = std::numeric_limits<float>::max(),
                  infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(to_float32(1e39), largest);
  EXPECT_EQ(to_float32(-1e300), -largest);
  EXPECT_EQ(to_float32(std::numeric_limits<double>::infinity()), infinity);
  EXPECT_TRUE(std::isnan(to_float32(std::nan(""))));
  EXPECT_THAT(to_float32(std::array{1.5, -1e40}), ElementsAre(1.5F, -largest));
}

}  // namespace
}  // namespace ashlar::stored_real_test
