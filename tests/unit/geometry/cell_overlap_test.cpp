#include "geometry/cell_overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ashlar {
namespace {

using Polygon = std::vector<Vector3>;

/// A rectangle in the plane z, counter-clockwise seen from +z.
Polygon rectangle(double x0, double y0, double x1, double y1, double z) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

Polygon turned_over(Polygon polygon) {
  return {polygon.rbegin(), polygon.rend()};
}

std::vector<OverlapCorner> overlap_from_above(const Polygon& a, const Polygon& b) {
  PredicateCounts counts;
  const ViewFrame frame(Vector3::Zero(), Vector3::UnitZ());
  return overlap_polygon(turned_over(a), b, frame, counts);
}

double area_of(const std::vector<OverlapCorner>& corners) {
  double sum = 0.0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto& p = corners[k].place;
    const auto& q = corners[(k + 1) % corners.size()].place;
    sum += 0.5 * (p.x() * q.y() - p.y() * q.x());
  }
  return sum;
}

int count_of(const std::vector<OverlapCorner>& corners, OverlapCornerKind kind) {
  int count = 0;
  for (const OverlapCorner& corner : corners) count += corner.kind == kind ? 1 : 0;
  return count;
}

TEST(CellOverlap, EqualSquaresGiveTheirFourCornersOnce) {
  const auto corners = overlap_from_above(rectangle(0, 0, 1, 1, 1), rectangle(0, 0, 1, 1, 0));
  EXPECT_EQ(corners.size(), 4U);
  EXPECT_EQ(count_of(corners, OverlapCornerKind::vertex_of_a), 4);
  EXPECT_NEAR(area_of(corners), 1.0, 1e-15);  // positive: counter-clockwise
}

TEST(CellOverlap, ShiftedSquaresGiveOneCornerEachAndTwoCrossings) {
  const auto corners = overlap_from_above(rectangle(0, 0, 1, 1, 0.1), rectangle(0.5, 0.25, 2, 2, 0));
  EXPECT_EQ(corners.size(), 4U);
  EXPECT_EQ(count_of(corners, OverlapCornerKind::vertex_of_a), 1);
  EXPECT_EQ(count_of(corners, OverlapCornerKind::vertex_of_b), 1);
  EXPECT_EQ(count_of(corners, OverlapCornerKind::crossing), 2);
  EXPECT_NEAR(area_of(corners), 0.375, 1e-15);
}

TEST(CellOverlap, OneInsideTheOther) {
  EXPECT_EQ(count_of(overlap_from_above(rectangle(0.2, 0.2, 0.4, 0.4, 1), rectangle(0, 0, 1, 1, 0)),
                     OverlapCornerKind::vertex_of_a),
            4);
  EXPECT_EQ(count_of(overlap_from_above(rectangle(0, 0, 1, 1, 1), rectangle(0.2, 0.2, 0.4, 0.4, 0)),
                     OverlapCornerKind::vertex_of_b),
            4);
}

TEST(CellOverlap, SharingASideOrACornerHasNoArea) {
  EXPECT_LT(overlap_from_above(rectangle(1, 0, 2, 1, 0), rectangle(0, 0, 1, 1, 0)).size(), 3U);
  EXPECT_LT(overlap_from_above(rectangle(1, 1, 2, 2, 0), rectangle(0, 0, 1, 1, 0)).size(), 3U);
  EXPECT_TRUE(overlap_from_above(rectangle(1.5, 0, 2, 1, 0), rectangle(0, 0, 1, 1, 0)).empty());
  const double ulp = std::nextafter(1.0, 0.0);
  EXPECT_GE(overlap_from_above(rectangle(ulp, 0, 2, 1, 0), rectangle(0, 0, 1, 1, 0)).size(), 3U);
}

TEST(CellOverlap, SquareTurnedByAnEighthGivesAnOctagon) {
  const double r = std::sqrt(2.0);
  const Polygon diamond = {{r, 0, 1}, {0, r, 1}, {-r, 0, 1}, {0, -r, 1}};
  const auto corners = overlap_from_above(diamond, rectangle(-1, -1, 1, 1, 0));
  EXPECT_EQ(corners.size(), 8U);
  EXPECT_EQ(count_of(corners, OverlapCornerKind::crossing), 8);
  EXPECT_NEAR(area_of(corners), 8.0 * (r - 1.0), 1e-14);  // regular octagon of inradius 1
}

TEST(CellOverlap, ExactArithmeticDecidesWhatTheFilterCannot) {
  PredicateCounts counts;
  const Vector3 w = Vector3::UnitZ();
  EXPECT_EQ(orientation_along(w, {0, 0, 5}, {1, 1, -3}, {2, 2, 7}, counts), 0);
  EXPECT_EQ(counts.exact, 1U);
  // 0.1 + 0.2 in double is above 0.3: (0.3, 0.3) against the line from (0,0) to (0.1 + 0.2, 0.3).
  EXPECT_EQ(orientation_along(w, {0, 0, 0}, {0.1 + 0.2, 0.3, 0}, {0.3, 0.3, 1}, counts), 1);
  EXPECT_EQ(orientation_along(w, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, counts), 1);
  EXPECT_EQ(orientation_along(-w, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, counts), -1);
  EXPECT_EQ(counts.filter, 2U);
}

TEST(CellOverlap, OrientationHoldsAtExtremeScales) {
  PredicateCounts counts;
  for (const int exponent : {-340, -200, 0, 200, 330}) {
    const double s = std::ldexp(1.0, exponent);
    EXPECT_EQ(orientation_along(Vector3::UnitZ(), {0, 0, 0}, {s, 0, 0}, {s, s, 0}, counts), 1);
    EXPECT_EQ(orientation_along(Vector3::UnitZ(), {0, 0, 0}, {s, s, 0}, {2 * s, 2 * s, s}, counts), 0);
  }
}

}  // namespace
}  // namespace ashlar
