#include "geometry/exact/predicate_ladder.hpp"

#include <gtest/gtest.h>

namespace ashlar::predicate_ladder_test {
namespace {

TEST(NumericRange, KnowsTheFirstAndLastBit) {
  NumericRange range;
  EXPECT_TRUE(range.safe());
  range.include(6.0);  // 110 in binary
  EXPECT_EQ(range.lowest_bit, 1);
  EXPECT_EQ(range.highest_bit, 3);
  range.include(-0.125);
  EXPECT_EQ(range.lowest_bit, -3);
  EXPECT_TRUE(range.safe());
  range.include(0x1p-1074);
  EXPECT_EQ(range.lowest_bit, -1074);
  EXPECT_FALSE(range.safe());
}

TEST(NumericRange, LowBitsCloseTheHighDegreesOnly) {
  const auto degree = [](double smallest, double largest) {
    NumericRange range;
    range.include(smallest);
    range.include(largest);
    return range.degree();
  };
  // 960 bits below one and 900 above are left for the powers.
  EXPECT_EQ(degree(0x1p-96, 1.0), 10);
  EXPECT_EQ(degree(0x1p-97, 1.0), 9);
  EXPECT_EQ(degree(0x1p-106, 1.0), 9);
  EXPECT_EQ(degree(0x1p-107, 1.0), 8);
  EXPECT_EQ(degree(0x1p-160, 1.0), 6);
  EXPECT_EQ(degree(0x1p-161, 1.0), 5);
  EXPECT_EQ(degree(0x1p-961, 1.0), 0);
  EXPECT_EQ(degree(1.0, 0x1p89), 10);  // below 2^90
  EXPECT_EQ(degree(1.0, 0x1p90), 9);
  EXPECT_EQ(degree(0x1p40, 0x1p90), 9);
  EXPECT_EQ(degree(0x1p-160, 0x1p224), 4);
}

}  // namespace
}  // namespace ashlar::predicate_ladder_test
