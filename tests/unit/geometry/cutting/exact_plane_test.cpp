#include "geometry/cutting/exact_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "support/exact_numbers.hpp"

namespace ashlar::exact_plane_test {
namespace {

TEST(ExactPlane, TellsPointsAnUlpApart) {
  // 0.1 x + 0.3 y = 0.1: at y = 0 the point x = 1 is on it exactly, its neighbours are not.
  const ExactPlane plane(CutPlane{{0.1, 0.3, 0.0}, {1, 0, 7}, 0.0});
  const double above = std::nextafter(1.0, 2.0), below = std::nextafter(1.0, 0.0);
  EXPECT_EQ(plane.side(ExactPoint::of({1, 0, -5})), 0);
  EXPECT_EQ(plane.side(ExactPoint::of({above, 0, -5})), 1);
  EXPECT_EQ(plane.side(ExactPoint::of({below, 0, -5})), -1);
  EXPECT_FALSE(plane.quick_side({1, 0, -5}).has_value());
  EXPECT_EQ(plane.quick_side({1.001, 0, 0}), 1);
}

TEST(ExactPlane, OffsetCountsAlongTheNormal) {
  const ExactPlane plane(CutPlane{{0, 0, 2}, {0, 0, 1}, 3.0});  // 2 (z - 1) = 3
  EXPECT_EQ(plane.side(ExactPoint::of({9, 9, 2.5})), 0);
  EXPECT_EQ(plane.unit_normal(), Vector3::UnitZ());
  EXPECT_EQ(plane.side_of_box({0, 0, 2.6}, {1, 1, 3}), 1);
  EXPECT_EQ(plane.side_of_box({0, 0, 2}, {1, 1, 2.4}), -1);
  EXPECT_EQ(plane.side_of_box({0, 0, 2}, {1, 1, 3}), 0);
}

TEST(ExactPlane, ThroughPointsAsTheRightHandTurns) {
  const ExactPlane plane = ExactPlane::through({0, 0, 1}, {1, 0, 1}, {0, 1, 1});
  EXPECT_EQ(plane.side(ExactPoint::of({0, 0, 2})), 1);
}

// x + y + z = 1, x = y, y = z meet in (1/3, 1/3, 1/3), which no double is.
TEST(ExactPlane, CommonPointIsExactAndRoundedOnce) {
  const ExactPlane sum(CutPlane{{1, 1, 1}, {1, 0, 0}}), xy(CutPlane{{1, -1, 0}, {0, 0, 0}}),
      yz(CutPlane{{0, 1, -1}, {0, 0, 0}});
  const auto point = common_point(sum, xy, yz);
  ASSERT_TRUE(point);
  EXPECT_EQ(point->rounded, Vector3::Constant(1.0 / 3.0));
  EXPECT_EQ(point->rational().x, Rational(1, 3));
  for (const ExactPlane* plane : {&sum, &xy, &yz}) EXPECT_EQ(plane->side(*point), 0);
  // The order and the sides of the planes do not matter.
  const auto other = common_point(yz, ExactPlane(CutPlane{{-1, 1, 0}, {0, 0, 0}}), sum);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->x, point->x);
  EXPECT_EQ(other->w, point->w);
  EXPECT_FALSE(common_point(xy, yz, ExactPlane(CutPlane{{1, 0, -1}, {5, 0, 0}})));
}

// Against fractions in lowest terms, rounded as everywhere in this layer.
TEST(ExactPlane, CommonPointsAreCorrectlyRounded) {
  std::mt19937_64 random(9);
  const auto number = [&] {
    return std::ldexp(static_cast<double>(random() % 2001) - 1000.0, -static_cast<int>(random() % 20));
  };
  const auto plane = [&] {
    Vector3 normal, point;
    for (double& x : normal) x = number();
    for (double& x : point) x = number();
    return ExactPlane(CutPlane{normal + Vector3(1e-9, 0, 0), point});
  };
  for (int round = 0; round < 2000; ++round) {
    const auto point = common_point(plane(), plane(), plane());
    if (!point) continue;
    const RationalVector exact = point->rational();
    EXPECT_EQ(point->rounded, round_to_nearest(exact));
  }
  // Ties go to even: x = p + s with p = 1 and s = 2^-53 is half way to the next double, s = 3 2^-53 after it.
  for (const auto& [offset, rounded] : {std::pair(0x1p-53, 1.0), std::pair(3 * 0x1p-53, 1.0 + 0x1p-51)}) {
    const auto tie =
        common_point(ExactPlane(CutPlane{{1, 0, 0}, {1, 0, 0}, offset}),
                     ExactPlane(CutPlane{{0, 1, 0}, {0, 0, 0}}), ExactPlane(CutPlane{{0, 0, 1}, {0, 0, 0}}));
    ASSERT_TRUE(tie);
    EXPECT_EQ(tie->rounded.x(), rounded);
  }
}

TEST(ExactPlane, HugeAndTinyCoordinates) {
  const ExactPlane far(CutPlane{{1, 0, 0}, {1e150, 0, 0}});
  EXPECT_EQ(far.side(ExactPoint::of({1e150, 1, 1})), 0);
  EXPECT_EQ(far.side(ExactPoint::of({1e149, 1e150, 1})), -1);
  const double tiny = std::numeric_limits<double>::denorm_min();
  const ExactPlane near(CutPlane{{1, 0, 0}, {tiny, 0, 0}});
  EXPECT_EQ(near.side(ExactPoint::of({0, 0, 0})), -1);
  EXPECT_EQ(near.side(ExactPoint::of({tiny, 0, 0})), 0);
}

}  // namespace
}  // namespace ashlar::exact_plane_test
