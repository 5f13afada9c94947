#include "mechanics/contact/pressure_end.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mechanics/contact/overlap_outline.hpp"

namespace ashlar::pressure_end_test {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

const Corners square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};

/// The line that end_of_pressure finds in the square for an affine gap c + s . p.
std::optional<PressureEnd> end_of(double constant, const Eigen::Vector2d& slope,
                                  const std::optional<PressureEnd>& known = {}, double tolerance = 1e-12) {
  const PolygonRule rule = polygon_rule(square, 2);
  std::vector<double> gaps;
  for (const Eigen::Vector2d& point : rule.points) gaps.push_back(constant + slope.dot(point));
  return end_of_pressure(square, rule, gaps, tolerance, known);
}

TEST(PressureEnd, PartsOfASquare) {
  // x + y = 1 cuts off a triangle of area 1/2.
  const PressureEnd end{{0.25, 0.75}, {3.0, 3.0}};
  const Corners pressed = part_under_pressure(square, end);
  const Corners open = part_without_pressure(square, end);
  ASSERT_EQ(pressed.size(), 3U);
  EXPECT_EQ(open.size(), 5U);
  EXPECT_DOUBLE_EQ(area_of(pressed), 0.5);
  EXPECT_DOUBLE_EQ(area_of(open), 3.5);
}

TEST(PressureEnd, ALineThroughCornersOrBesideThem) {
  const PressureEnd diagonal{{0, 0}, {1, -1}};
  EXPECT_EQ(part_under_pressure(square, diagonal), (Corners{{0, 0}, {2, 2}, {0, 2}}));
  EXPECT_EQ(part_without_pressure(square, diagonal), (Corners{{0, 0}, {2, 0}, {2, 2}}));
  const PressureEnd beside{{3, 0}, {1, 0}};
  EXPECT_EQ(part_under_pressure(square, beside), square);
  EXPECT_TRUE(part_without_pressure(square, beside).empty());
}

TEST(PressureEnd, AffineGapsAreCutWhereTheyAreZero) {
  const auto end = end_of(-0.3, {0.5, 0.0});
  ASSERT_TRUE(end.has_value());
  // x = 0.6, open beyond it
  EXPECT_NEAR(end->point.x(), 0.6, 1e-14);
  EXPECT_NEAR(end->open.y(), 0.0, 1e-15);
  EXPECT_GT(end->open.x(), 0.0);
}

TEST(PressureEnd, WhatIsWhollyPressedOrOpenOrFlushIsNotCut) {
  EXPECT_FALSE(end_of(-2.0, {0.5, 0.0}).has_value());
  EXPECT_FALSE(end_of(0.1, {0.5, 0.0}).has_value());
  EXPECT_FALSE(end_of(-3e-13, {5e-13, 0.0}).has_value());
  EXPECT_FALSE(end_of_pressure({}, {}, {}, 1e-12, std::nullopt).has_value());
}

TEST(PressureEnd, JointsThatBulgeHaveNoLine) {
  const PolygonRule rule = polygon_rule(square, 2);
  const auto end_with_tilt = [&](double tilt) {
    std::vector<double> gaps;
    for (const Eigen::Vector2d& point : rule.points)
      gaps.push_back((point - Eigen::Vector2d(1, 1)).squaredNorm() - 0.5 + tilt * (point.x() - 1.0));
    return end_of_pressure(square, rule, gaps, 1e-12, std::nullopt);
  };
  EXPECT_FALSE(end_with_tilt(0.0).has_value());
  EXPECT_FALSE(end_with_tilt(1e-9).has_value());
  EXPECT_TRUE(end_with_tilt(2.0).has_value());
}

TEST(PressureEnd, ACutStaysUntilPressureEndsElsewhere) {
  const PressureEnd known{{0.6, 0.0}, {1.0, 0.0}};
  // At 0.61 the pressed part, 1.22, differs by 0.02: a sixtieth. At 0.65 it is a thirteenth.
  const auto same = end_of(-0.305, {0.5, 0.0}, known);
  ASSERT_TRUE(same.has_value());
  EXPECT_EQ(same->point, known.point);
  const auto other = end_of(-0.325, {0.5, 0.0}, known);
  ASSERT_TRUE(other.has_value());
  EXPECT_NEAR(other->point.x(), 0.65, 1e-14);
  // Turned about (0.6, 1) by a tenth: two triangles of 0.05 differ, the pressed area does not.
  const auto turned = end_of(-0.7, {1.0, 0.1}, known);
  ASSERT_TRUE(turned.has_value());
  EXPECT_NEAR(turned->open.y() / turned->open.x(), 0.1, 1e-14);
}

TEST(PressureEnd, ACutGoesOnWhereNoPointIsUnderPressure) {
  // A gap that bulges, (x - 0.3)^2 + 0.01, its affine part 1.4 x - 0.5667: an existing cut continues at its
  // zero, 0.40476, none begins.
  const PolygonRule rule = polygon_rule(square, 4);
  std::vector<double> gaps;
  for (const Eigen::Vector2d& point : rule.points) gaps.push_back(std::pow(point.x() - 0.3, 2) + 0.01);
  const PressureEnd known{{0.5, 0.0}, {1.0, 0.0}};
  EXPECT_FALSE(end_of_pressure(square, rule, gaps, 1e-12, std::nullopt).has_value());
  const auto end = end_of_pressure(square, rule, gaps, 1e-12, known);
  ASSERT_TRUE(end.has_value());
  EXPECT_NEAR(end->point.x() - end->open.y() / end->open.x() * end->point.y(), 0.40476190476190477, 1e-12);
  // Nor does it go on where the square is open, or pressed, to its end.
  EXPECT_FALSE(end_of(0.1, {1.0, 0.0}, known).has_value());
  EXPECT_FALSE(end_of(-2.1, {1.0, 0.0}, known).has_value());
}

TEST(PressureEnd, ASliverIsNotCutOff) {
  // Open beyond x = 1.99: a two hundredth of the pressed part. Beyond 1.9 it is a nineteenth.
  EXPECT_FALSE(end_of(-1.99, {1.0, 0.0}).has_value());
  EXPECT_TRUE(end_of(-1.9, {1.0, 0.0}).has_value());
  // Once cut, it stays cut until all but a twentieth is pressed.
  const PressureEnd known{{1.98, 0.0}, {1.0, 0.0}};
  EXPECT_TRUE(end_of(-1.99, {1.0, 0.0}, known).has_value());
  const PressureEnd left{{1.8, 0.0}, {1.0, 0.0}};
  EXPECT_FALSE(end_of(-3.0, {1.0, 0.0}, left).has_value());
  // A sliver that is all there is under pressure is cut off.
  EXPECT_TRUE(end_of(-0.01, {1.0, 0.0}).has_value());
  EXPECT_FALSE(end_of(0.01, {1.0, 0.0}, left).has_value());
}

}  // namespace
}  // namespace ashlar::pressure_end_test
