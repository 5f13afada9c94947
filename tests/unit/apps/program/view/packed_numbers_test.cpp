#include "apps/program/view/packed_numbers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "unit/apps/program/view/packed_reader.hpp"

namespace ashlar::packed_numbers_test {
namespace {

using ::testing::ElementsAre;

PackedReader reader_of(const PackedNumbers& numbers) {
  return PackedReader(inflated(numbers.base64()));
}

TEST(PackedNumbers, WholeNumbersAreDifferencesLowBytesFirst) {
  PackedNumbers numbers;
  numbers.add_integers({1, 258, 0, 65535});
  // Differences 1, 257 = 0x0101, -258 = 0xFEFE, 65535 = 0xFFFF.
  const std::string expected = {'\x01', '\x01', '\xFE', '\xFF', '\x00', '\x01', '\xFE', '\xFF'};
  EXPECT_EQ(numbers.bytes(), expected);
  EXPECT_THAT(reader_of(numbers).words(4), ElementsAre(1, 258, 0, 65535));
}

TEST(PackedNumbers, RealsKeepTheirDigitsBesideLargeOnes) {
  const std::vector<double> values = {1e9, -1e9, 0.0, 1e3, -2.5e7, 123456.0};
  PackedNumbers numbers;
  numbers.add_reals(values, 1);
  PackedReader reader = reader_of(numbers);
  const std::vector<float> read = reader.reals(6, 1);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(read[i], values[i], std::sqrt(std::abs(values[i]) * 1e9) / 32767 + 1e9 / 32767 / 32767)
        << values[i];
  EXPECT_EQ(read[0], 1e9F);
  EXPECT_EQ(read[1], -1e9F);
  EXPECT_EQ(read[2], 0.0F);
  EXPECT_TRUE(reader.at_end());
}

TEST(PackedNumbers, TuplesArePackedByComponent) {
  PackedNumbers numbers;
  numbers.add_reals({1.0, -1.0, 0.25, 0.0}, 2);  // roots 1, 1/2 and -1, 0
  PackedReader reader = reader_of(numbers);
  EXPECT_EQ(reader.number(), 1.0F);
  EXPECT_THAT(reader.words(4, true), ElementsAre(32767, 16384, -32767, 0));
}

TEST(PackedNumbers, WhatIsNoNumberStaysNone) {
  PackedNumbers numbers;
  numbers.add_reals({std::numeric_limits<double>::quiet_NaN(), 2.0, std::numeric_limits<double>::infinity()},
                    1);
  const std::vector<float> read = reader_of(numbers).reals(3, 1);
  EXPECT_TRUE(std::isnan(read[0]));
  EXPECT_EQ(read[1], 2.0F);
  EXPECT_TRUE(std::isnan(read[2]));
}

TEST(PackedNumbers, ZerosAndNothing) {
  PackedNumbers numbers;
  numbers.add_reals({0.0, 0.0}, 1);
  numbers.add_points({});
  PackedReader reader = reader_of(numbers);
  EXPECT_THAT(reader.reals(2, 1), ElementsAre(0.0F, 0.0F));
  EXPECT_TRUE(reader.points(0).empty());
  EXPECT_TRUE(reader.at_end());
}

TEST(PackedNumbers, PointsAreSharesOfTheirBox) {
  PackedNumbers numbers;
  // z is the same for all: a side of no length.
  numbers.add_points({{-1.0, 10.0, 5.0}, {3.0, 20.0, 5.0}, {0.0, 12.5, 5.0}});
  const auto read = reader_of(numbers).points(3);
  EXPECT_THAT(read[0], ElementsAre(-1.0F, 10.0F, 5.0F));
  EXPECT_THAT(read[1], ElementsAre(3.0F, 20.0F, 5.0F));
  EXPECT_NEAR(read[2][0], 0.0, 4.0 / 131070 + 1e-6);
  EXPECT_NEAR(read[2][1], 12.5, 10.0 / 131070 + 1e-5);
}

TEST(PackedNumbers, ABlockThatFliesAwayCostsTheOthersNoDigit) {
  const std::vector<Vector3> displacements = {{1e-6, 0, 0}, {3e-6, 0, 0}, {1000, 0, 0}, {1000.5, 2, 0}};
  const std::vector<int> blocks = {0, 0, 1, 1};
  PackedNumbers numbers;
  numbers.add_displacements(displacements, blocks);
  const auto read = reader_of(numbers).displacements({{0, 2}, {2, 4}}, 4);
  // Spreads 1e-6 < 2^-19 and 1 = 2^0; floats near 1000 are 6e-5 apart.
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(read[i][0], displacements[i].x(), std::ldexp(1.0, -35));
  for (std::size_t i = 2; i < 4; ++i)
    EXPECT_NEAR(read[i][0], displacements[i].x(), std::ldexp(1.0, -16) + 6.2e-5);
  EXPECT_EQ(read[3][1], 2.0F);
  EXPECT_EQ(read[2][1], 0.0F);
}

TEST(PackedNumbers, AnAbsentBlockHasNoPlace) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  PackedNumbers numbers;
  numbers.add_displacements({{none, none, none}, {1, 2, 3}}, std::vector<int>{0, 1});
  const auto read = reader_of(numbers).displacements({{0, 1}, {1, 2}}, 2);
  EXPECT_TRUE(std::isnan(read[0][0]));
  EXPECT_THAT(read[1], ElementsAre(1.0F, 2.0F, 3.0F));
}

}  // namespace
}  // namespace ashlar::packed_numbers_test
