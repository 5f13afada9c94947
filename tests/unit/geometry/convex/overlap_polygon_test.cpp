#include "geometry/convex/overlap_polygon.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>
#include <tuple>
#include <vector>

namespace ashlar::overlap_polygon_test {
namespace {

// (dimension on a, dimension on b) of each vertex, in the order of the loop.
using Pairs = std::vector<std::pair<int, int>>;

struct Projection {
  Vector3 up{0.0, 0.0, 1.0};
  ContactDirection w = ContactDirection::along({&up});
  PredicateLadder ladder;

  std::vector<OverlapVertex> overlap_of(const std::vector<Vector3>& a, const std::vector<Vector3>& b,
                                        PlaneSetting setting = PlaneSetting::level) {
    std::vector<int> loop_a(a.size()), loop_b(b.size());
    std::iota(loop_a.begin(), loop_a.end(), 0);
    std::iota(loop_b.begin(), loop_b.end(), 0);
    return overlap(w, setting, {a.data(), loop_a}, {b.data(), loop_b}, ladder);
  }
};

std::multiset<std::pair<int, int>> pairs_of(const std::vector<OverlapVertex>& vertices) {
  std::multiset<std::pair<int, int>> pairs;
  for (const OverlapVertex& v : vertices) pairs.emplace(v.a.dimension, v.b.dimension);
  return pairs;
}

const std::vector<Vector3> square{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};

TEST(OverlapPolygon, ShiftedSquaresMeetInASquareWithTwoCrossings) {
  Projection projection;
  const auto vertices = projection.overlap_of(square, {{1, 1, 5}, {3, 1, 5}, {3, 3, 5}, {1, 3, 5}});
  ASSERT_EQ(vertices.size(), 4U);
  EXPECT_EQ(pairs_of(vertices), (std::multiset<std::pair<int, int>>{{0, 2}, {1, 1}, {1, 1}, {2, 0}}));
  // The corner of a is followed by the crossing of its upper side, counter-clockwise.
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_TRUE(vertices[k].a.dimension != 0 || vertices[(k + 1) % 4].a.index == 2);
}

TEST(OverlapPolygon, IdenticalSquaresHaveOnlyCorners) {
  Projection projection;
  const auto vertices = projection.overlap_of(square, square, PlaneSetting::coplanar);
  EXPECT_EQ(pairs_of(vertices), (std::multiset<std::pair<int, int>>{{0, 0}, {0, 0}, {0, 0}, {0, 0}}));
}

TEST(OverlapPolygon, SquaresSideBySideMeetInPartOfASide) {
  Projection projection;
  const auto vertices = projection.overlap_of(square, {{2, 1, 0}, {4, 1, 0}, {4, 3, 0}, {2, 3, 0}});
  EXPECT_EQ(pairs_of(vertices), (std::multiset<std::pair<int, int>>{{0, 1}, {1, 0}}));
}

TEST(OverlapPolygon, CornersThatTouch) {
  Projection projection;
  EXPECT_EQ(pairs_of(projection.overlap_of(square, {{2, 2, 0}, {3, 2, 0}, {3, 3, 0}})),
            (std::multiset<std::pair<int, int>>{{0, 0}}));
  EXPECT_TRUE(projection.overlap_of(square, {{2.5, 2, 0}, {3, 2, 0}, {3, 3, 0}}).empty());
}

TEST(OverlapPolygon, ASideThroughTwoCornersOfTheOther) {
  // The upper side y = 0 of a runs along a diagonal of b and leaves a triangle below it.
  Projection projection;
  const auto vertices = projection.overlap_of({{-4, -8, 0}, {4, 0, 0}, {-4, 0, 0}},
                                              {{-2, 0, 0}, {-2, -4, 0}, {2, 0, 0}, {2, 4, 0}});
  EXPECT_EQ(pairs_of(vertices), (std::multiset<std::pair<int, int>>{{1, 0}, {1, 0}, {2, 0}}));
}

TEST(OverlapPolygon, SegmentsAndPoints) {
  Projection projection;
  const std::vector<Vector3> along{{-1, 1, 0}, {1, 1, 0}};
  EXPECT_EQ(pairs_of(projection.overlap_of(along, square)),
            (std::multiset<std::pair<int, int>>{{0, 2}, {1, 1}}));
  EXPECT_EQ(pairs_of(projection.overlap_of(along, {{0, 1, 3}, {5, 1, 3}})),
            (std::multiset<std::pair<int, int>>{{1, 0}, {0, 1}}));
  EXPECT_EQ(pairs_of(projection.overlap_of(along, {{0, 0, 3}, {0, 5, 3}})),
            (std::multiset<std::pair<int, int>>{{1, 1}}));
  EXPECT_EQ(pairs_of(projection.overlap_of({{2, 1, 0}}, square)),
            (std::multiset<std::pair<int, int>>{{0, 1}}));
  EXPECT_TRUE(projection.overlap_of({{2, 1, 0}}, {{2, 1.5, 0}}).empty());
}

TEST(OverlapPolygon, CarrierOfASetOfLocations) {
  const std::vector<int> loop{0, 1, 2, 3};
  const PlaneSet set{square.data(), loop};
  const auto carrier_dimension = [&](std::vector<PlaneLocation> l) { return carrier(set, l).dimension; };
  EXPECT_EQ(carrier_dimension({{0, 3}}), 0);
  EXPECT_EQ(carrier_dimension({{0, 3}, {0, 0}}), 1);
  EXPECT_EQ(carrier_dimension({{0, 0}, {1, 3}}), 1);
  EXPECT_EQ(carrier_dimension({{0, 0}, {0, 2}}), 2);
  EXPECT_EQ(carrier_dimension({{1, 0}, {1, 1}}), 2);
}

TEST(OverlapPolygon, ProjectedHullDropsInnerAndCollinearPoints) {
  Projection projection;
  const std::vector<Vector3> points{{1, 1, 7}, {0, 0, 0}, {2, 0, 3}, {1, 0, 1},
                                    {2, 2, 1}, {0, 2, 2}, {2, 2, 9}};
  const std::vector<int> hull =
      projected_hull(projection.w, points.data(), {0, 1, 2, 3, 4, 5, 6}, projection.ladder);
  ASSERT_EQ(hull.size(), 4U);
  EXPECT_EQ(std::set<int>(hull.begin(), hull.end()), (std::set<int>{1, 2, 4, 5}));
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(sign_turn(projection.w, points[hull[k]], points[hull[(k + 1) % 4]], points[hull[(k + 2) % 4]],
                        projection.ladder),
              1);
  EXPECT_EQ(projected_hull(projection.w, points.data(), {4, 6}, projection.ladder), std::vector<int>{4});
  EXPECT_EQ(projected_hull(projection.w, points.data(), {1, 3, 2}, projection.ladder).size(), 2U);
}

}  // namespace
}  // namespace ashlar::overlap_polygon_test
