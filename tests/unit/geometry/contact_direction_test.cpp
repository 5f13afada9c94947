#include "geometry/contact_direction.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ashlar {
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

class Ladders : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override { ladder.floating = GetParam(); }
  PredicateLadder ladder;
};
INSTANTIATE_TEST_SUITE_P(FilteredAndExact, Ladders, testing::Bool(),
                         [](const auto& each) { return each.param ? "filtered" : "exact"; });

const Vector3 origin(0, 0, 0), x(1, 0, 0), y(0, 1, 0);

TEST_P(Ladders, SignsOneBitFromThePlane) {
  const ContactDirection w = ContactDirection::cross({&x, &origin}, {&y, &origin});
  const Vector3 above(0.3, 0.7, 0x1p-60), below(0.3, 0.7, -0x1p-60), on(0.3, 0.7, 0.0);
  EXPECT_EQ(sign_along(w, above, origin, ladder), 1);
  EXPECT_EQ(sign_along(w, below, origin, ladder), -1);
  EXPECT_EQ(sign_along(w, on, origin, ladder), 0);
}

TEST_P(Ladders, ThePlaneThroughThreeTiltedPoints) {
  // z = x + y; the last coordinate of the fourth point is changed by an ulp.
  const Vector3 a(0, 0, 0), b(1, 0, 1), c(0, 1, 1);
  const ContactDirection w = ContactDirection::cross({&b, &a}, {&c, &a});
  const double z = 0.1 + 0.25;  // what 0.1 + 0.25 rounds to is not the sum
  const Vector3 p(0.5, 0.25, 0.75), q(0.5, 0.25, std::nextafter(0.75, 1.0)), r(0.1, 0.25, z);
  EXPECT_EQ(sign_along(w, p, a, ladder), 0);
  EXPECT_EQ(sign_along(w, q, a, ladder), 1);
  const double rest = (0.1 - (z - 0.25)) + 0.0;  // exact by Sterbenz: 0.1 + 0.25 - z
  EXPECT_EQ(sign_along(w, r, a, ladder), rest > 0.0 ? -1 : rest < 0.0 ? 1 : 0);
}

TEST_P(Ladders, HeightsAreRoundedOnce) {
  // w = (1, 1, 1): the height of (1, 0, 0) is 1/sqrt(3), its step (1/3, 1/3, 1/3).
  const Vector3 ones(1, 1, 1);
  const ContactDirection w = ContactDirection::along({&ones, &origin});
  const ContactHeight height(w, {&x, &origin}, ladder);
  EXPECT_EQ(height.squared(), 1.0 / 3.0);
  EXPECT_EQ(height.length(), std::sqrt(1.0 / 3.0));  // the root of 1/3 rounds alike for both
  EXPECT_EQ(height.step(), Vector3::Constant(1.0 / 3.0));
  EXPECT_EQ(height.above(x), Vector3(4.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0));
  EXPECT_EQ(height.below(x), Vector3(2.0 / 3.0, -1.0 / 3.0, -1.0 / 3.0));
}

TEST_P(Ladders, UnitVectorsDoNotDependOnTheLengthOfW) {
  const Vector3 shorter(3, 4, 0), longer(3e10, 4e10, 0);
  for (const Vector3* p : {&shorter, &longer}) {
    const Vector3 unit = unit_vector(ContactDirection::along({p, &origin}), ladder);
    EXPECT_EQ(unit, Vector3(0.6, 0.8, 0.0));
  }
}

TEST_P(Ladders, CrossingsAreRoundedOnce) {
  const Vector3 up(0, 0, 1), a(0, 0, 0), b(1, 3, 0), c(-1, 1, 7), d(5, 1, 7);
  const ContactDirection w = ContactDirection::along({&up, &origin});
  EXPECT_EQ(crossing_point(w, a, b, c, d, ladder), Vector3(1.0 / 3.0, 1.0, 0.0));
  EXPECT_EQ(crossing_point(w, c, d, a, b, ladder), Vector3(1.0 / 3.0, 1.0, 7.0));
  const Vector3 low(0, 0, -1), high(1, 5, 2);
  EXPECT_EQ(plane_point(w, low, high, origin, ladder), Vector3(1.0 / 3.0, 5.0 / 3.0, 0.0));
}

TEST_P(Ladders, Bounds) {
  const Vector3 up(0, 0, 3), p(4, 0, 3);
  const ContactDirection w = ContactDirection::along({&up, &origin});
  const Difference d{&p, &origin};
  EXPECT_TRUE(is_within(w, d, 3.0, false, ladder));
  EXPECT_FALSE(is_within(w, d, std::nextafter(3.0, 0.0), false, ladder));
  EXPECT_FALSE(is_within(w, d, 0.59, true, ladder));  // the sine is 3/5
  EXPECT_TRUE(is_within(w, d, 0.61, true, ladder));
}

}  // namespace
}  // namespace ashlar
