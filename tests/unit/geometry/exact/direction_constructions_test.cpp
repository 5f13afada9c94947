#include "geometry/exact/direction_constructions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/exact/exact_constructions.hpp"

namespace ashlar::direction_constructions_test {
namespace {

class ConstructionLadders : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override { ladder.floating = GetParam(); }
  PredicateLadder ladder;
};
INSTANTIATE_TEST_SUITE_P(FilteredAndExact, ConstructionLadders, testing::Bool(),
                         [](const auto& each) { return each.param ? "filtered" : "exact"; });

const Vector3 origin(0, 0, 0), x(1, 0, 0);

TEST_P(ConstructionLadders, HeightsAreRoundedOnce) {
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

TEST_P(ConstructionLadders, UnitVectorsDoNotDependOnTheLengthOfW) {
  const Vector3 shorter(3, 4, 0), longer(3e10, 4e10, 0);
  for (const Vector3* p : {&shorter, &longer}) {
    const Vector3 unit = unit_vector(ContactDirection::along({p, &origin}), ladder);
    EXPECT_EQ(unit, Vector3(0.6, 0.8, 0.0));
  }
}

TEST_P(ConstructionLadders, CrossingsAreRoundedOnce) {
  const Vector3 up(0, 0, 1), a(0, 0, 0), b(1, 3, 0), c(-1, 1, 7), d(5, 1, 7);
  const ContactDirection w = ContactDirection::along({&up, &origin});
  EXPECT_EQ(crossing_point(w, a, b, c, d, ladder), Vector3(1.0 / 3.0, 1.0, 0.0));
  EXPECT_EQ(crossing_point(w, c, d, a, b, ladder), Vector3(1.0 / 3.0, 1.0, 7.0));
  const Vector3 low(0, 0, -1), high(1, 5, 2);
  EXPECT_EQ(plane_point(w, low, high, origin, ladder), Vector3(1.0 / 3.0, 5.0 / 3.0, 0.0));
}

TEST(ExactConstructions, EachValueIsRoundedOnce) {
  const Vector3 ones(1, 1, 1);
  const ContactDirection w = ContactDirection::along({&ones, &origin});
  const Difference d{&x, &origin};
  EXPECT_EQ(exact_squared_height(w, d), 1.0 / 3.0);
  EXPECT_EQ(exact_height(w, d), std::sqrt(1.0 / 3.0));
  EXPECT_EQ(exact_shifted(w, d, nullptr, -1, 2), -1.0 / 3.0);
  EXPECT_EQ(exact_shifted(w, d, &x, 1, 0), 4.0 / 3.0);
  EXPECT_EQ(exact_unit_component(w, 1), std::sqrt(1.0 / 3.0));
}

TEST(ExactConstructions, PointsOverALineAndInAPlane) {
  const Vector3 up(0, 0, 1), a(0, 0, -1), b(1, 5, 2), c(-1, 1, 7), d(5, 1, 7);
  const ContactDirection w = ContactDirection::along({&up, &origin});
  EXPECT_EQ(exact_point_between(w, a, b, HeightsOverLine{a, b, c, d}, 0), 0.2);
  EXPECT_EQ(exact_point_between(w, a, b, HeightsOverLine{a, b, c, d}, 2), -0.4);
  EXPECT_EQ(exact_point_between(w, a, b, HeightsOverPlane{a, b, origin}, 1), 5.0 / 3.0);
}

}  // namespace
}  // namespace ashlar::direction_constructions_test
