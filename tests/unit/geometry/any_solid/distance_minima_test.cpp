#include "geometry/any_solid/distance_minima.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/solid/shapes.hpp"
#include "support/exact_numbers.hpp"
#include "support/sample_meshes.hpp"

namespace ashlar::distance_minima_test {
namespace {

/// A minimum as its features' dimensions, the vector from B to A and the places on A, m.
struct Expected {
  int of_a, of_b;
  Vector3 w;
  std::vector<Vector3> on_a;
};

std::vector<DistanceMinimum> minima_of(const TriangleMesh& a, const TriangleMesh& b, double distance) {
  const Polyhedron solid_a(a), solid_b(b);
  DecisionCounts counts;
  MinimumBound bound;
  bound.distance = distance;
  return find_distance_minima(SolidFeatures(solid_a), SolidFeatures(solid_b), bound, counts);
}

bool precedes(const Vector3& x, const Vector3& y) {
  return std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end());
}

/// Holds for both orders of the solids, and where products of four lengths are out of the range of doubles.
void expect_only(const TriangleMesh& a, const TriangleMesh& b, double distance, const Expected& expected) {
  for (const double scale : {1.0, 0x1p300, 0x1p-300}) {
    TriangleMesh of_a = a, of_b = b;
    for (TriangleMesh* mesh : {&of_a, &of_b})
      for (Vector3& point : mesh->points) point *= scale;
    for (const bool swapped : {false, true}) {
      SCOPED_TRACE(testing::Message() << scale << (swapped ? " swapped" : ""));
      const std::vector<DistanceMinimum> minima =
          swapped ? minima_of(of_b, of_a, distance * scale) : minima_of(of_a, of_b, distance * scale);
      ASSERT_EQ(minima.size(), 1U);
      const DistanceMinimum& minimum = minima.front();
      EXPECT_EQ((swapped ? minimum.b : minimum.a).dimension, expected.of_a);
      EXPECT_EQ((swapped ? minimum.a : minimum.b).dimension, expected.of_b);
      const Vector3 w = round_to_nearest(minimum.w);
      EXPECT_EQ(w, (swapped ? -scale : scale) * expected.w);
      EXPECT_EQ(minimum.dimension, expected.on_a.size() == 1 ? 0 : expected.on_a.size() == 2 ? 1 : 2);
      std::vector<Vector3> places;
      for (const MinimumPoint& point : minimum.points) {
        const RationalVector on_b = difference(point.on_a, minimum.w);
        places.emplace_back(round_to_nearest(swapped ? on_b : point.on_a) / scale);
      }
      std::sort(places.begin(), places.end(), precedes);
      EXPECT_EQ(places, expected.on_a);
    }
  }
}

const TriangleMesh unit_cube = make_box({0, 0, 0}, {1, 1, 1});

/// A wedge that points down to an edge along y, and one that points up to an edge along x.
TriangleMesh wedge_down(double x, double from, double to, double z) {
  return make_convex_hull(std::vector<Vector3>{{x, from, z},
                                               {x, to, z},
                                               {x - 1, from, z + 1},
                                               {x - 1, to, z + 1},
                                               {x + 1, from, z + 1},
                                               {x + 1, to, z + 1}});
}
TriangleMesh roof() {
  return make_convex_hull(
      std::vector<Vector3>{{0, 1, 1}, {2, 1, 1}, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}});
}
/// A pyramid on its tip.
TriangleMesh tip(const Vector3& at) {
  std::vector<Vector3> points = {at};
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) points.emplace_back(at + Vector3(x, y, 1));
  return make_convex_hull(points);
}

TEST(DistanceMinima, OfTwoCorners) {
  expect_only(unit_cube, make_box({2, 3, 2}, {4, 4, 4}), 8.0, {0, 0, {-1, -2, -1}, {{1, 1, 1}}});
  expect_only(unit_cube, make_box({1, 1, 1}, {2, 2, 2}), 0.5, {0, 0, {0, 0, 0}, {{1, 1, 1}}});
}

TEST(DistanceMinima, OfParallelEdges) {
  expect_only(unit_cube, make_box({2, 2, 0.25}, {3, 3, 0.5}), 2.0,
              {1, 1, {-1, -1, 0}, {{1, 1, 0.25}, {1, 1, 0.5}}});
  expect_only(unit_cube, make_box({2, 2, 0.5}, {3, 3, 2}), 2.0,
              {1, 1, {-1, -1, 0}, {{1, 1, 0.5}, {1, 1, 1}}});
  expect_only(unit_cube, make_box({2, 2, 0}, {3, 3, 1}), 2.0, {1, 1, {-1, -1, 0}, {{1, 1, 0}, {1, 1, 1}}});
  expect_only(unit_cube, make_box({1, 1, 0.5}, {3, 3, 2}), 0.5, {1, 1, {0, 0, 0}, {{1, 1, 0.5}, {1, 1, 1}}});
}

TEST(DistanceMinima, OfEdgesThatCross) {
  expect_only(roof(), wedge_down(0.75, 0.5, 4, 2), 1.0, {1, 1, {0, 0, -1}, {{0.75, 1, 1}}});
  expect_only(roof(), wedge_down(0.75, 0.5, 4, 1), 0.5, {1, 1, {0, 0, 0}, {{0.75, 1, 1}}});
}

TEST(DistanceMinima, OfAnEdgeAndAFace) {
  const TriangleMesh slab = make_box({0, 0, 0}, {4, 4, 1});
  expect_only(slab, wedge_down(2, 1, 3, 2), 1.0, {2, 1, {0, 0, -1}, {{2, 1, 1}, {2, 3, 1}}});
  expect_only(slab, wedge_down(2, 3, 6, 2), 1.0, {2, 1, {0, 0, -1}, {{2, 3, 1}, {2, 4, 1}}});
  expect_only(slab, wedge_down(2, -1, 6, 1), 0.5, {2, 1, {0, 0, 0}, {{2, 0, 1}, {2, 4, 1}}});
}

TEST(DistanceMinima, OfACornerAndAFace) {
  const TriangleMesh slab = make_box({0, 0, 0}, {4, 4, 1});
  expect_only(slab, tip({1, 2, 2}), 1.0, {2, 0, {0, 0, -1}, {{1, 2, 1}}});
  expect_only(slab, tip({1, 2, 1}), 0.5, {2, 0, {0, 0, 0}, {{1, 2, 1}}});
}

TEST(DistanceMinima, OfACornerAndAnEdge) {
  const TriangleMesh slab = make_box({0, 0, 0}, {4, 4, 1});
  expect_only(slab, tip({4.5, 2, 2}), 2.0, {1, 0, {-0.5, 0, -1}, {{4, 2, 1}}});
  expect_only(slab, tip({4, 2, 1}), 0.5, {1, 0, {0, 0, 0}, {{4, 2, 1}}});
}

TEST(DistanceMinima, OfFaces) {
  expect_only(unit_cube, make_box({0.5, -1, 1.5}, {3, 0.25, 2}), 0.5,
              {2, 2, {0, 0, -0.5}, {{0.5, 0, 1}, {0.5, 0.25, 1}, {1, 0, 1}, {1, 0.25, 1}}});
  const std::vector<DistanceMinimum> minima =
      minima_of(unit_cube, make_box({0.5, -1, 1.5}, {3, 0.25, 2}), 0.5);
  EXPECT_EQ(minima.front().squared_area, Rational(1, 64));
}

TEST(DistanceMinima, AreOnlyAsFarApartAsIsAsked) {
  const double below = std::nextafter(1.0, 0.0);
  const TriangleMesh slab = make_box({0, 0, 0}, {4, 4, 1});
  EXPECT_TRUE(minima_of(slab, tip({1, 2, 2}), below).empty());
  EXPECT_TRUE(minima_of(slab, wedge_down(2, 1, 3, 2), below).empty());
  EXPECT_TRUE(minima_of(roof(), wedge_down(1, 0.5, 4, 2), below).empty());
  EXPECT_TRUE(minima_of(unit_cube, make_box({0, 0, 2}, {1, 1, 3}), below).empty());
  EXPECT_TRUE(minima_of(unit_cube, make_box({0, 2, 1}, {1, 3, 2}), below).empty()) << "edges";
  EXPECT_TRUE(minima_of(unit_cube, make_box({1, 1, 2}, {2, 2, 3}), below).empty()) << "corners";
}

// Solids that are not convex have several: a plug in the hole of a frame one for each side of the hole, and a tip over
// the notch of an L one for each edge of the notch.
TEST(DistanceMinima, OfSolidsThatAreNotConvexAreSeveral) {
  const std::vector<DistanceMinimum> sides =
      minima_of(test_support::make_frame(), make_box({1.25, 1.25, -1}, {1.75, 1.75, 2}), 0.25);
  ASSERT_EQ(sides.size(), 4U);
  for (const DistanceMinimum& side : sides) {
    EXPECT_EQ(side.dimension, 2);
    EXPECT_EQ(side.squared_area, Rational(1, 4));
    EXPECT_EQ(dot_product(side.w, side.w), Rational(1, 16));
  }
  const std::vector<DistanceMinimum> edges = minima_of(test_support::make_l_prism(), tip({1.5, 1.5, 2}), 2.0);
  ASSERT_EQ(edges.size(), 2U);
  for (const DistanceMinimum& edge : edges) {
    EXPECT_EQ(edge.a.dimension, 1);
    EXPECT_EQ(edge.b.dimension, 0);
    EXPECT_EQ(dot_product(edge.w, edge.w), Rational(5, 4));
  }
  EXPECT_NE(round_to_nearest(edges[0].w), round_to_nearest(edges[1].w));
}

// A reflex edge or corner is nearest only to features in contact with it: the tip over the inner edge of an L is nearer to the
// notch's faces, and one that stands in the valley touches both.
TEST(DistanceMinima, AValleyIsNearestOnlyToWhatTouchesIt) {
  const TriangleMesh valley = test_support::make_prism(
      {{0, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}, {{0, 1, 3}, {1, 2, 3}, {0, 3, 4}}, {{0, 1, 2, 3, 4}}, 2.0);
  const auto ridge = [](double y) {
    return make_convex_hull(std::vector<Vector3>{{1, y, 0.5},
                                                 {1, y, 1.5},
                                                 {0.75, y + 1, 0.5},
                                                 {0.75, y + 1, 1.5},
                                                 {1.25, y + 1, 0.5},
                                                 {1.25, y + 1, 1.5}});
  };
  const std::vector<DistanceMinimum> above = minima_of(valley, ridge(1.5), 1.0);
  ASSERT_EQ(above.size(), 2U);
  for (const DistanceMinimum& minimum : above) {
    EXPECT_EQ(minimum.a.dimension, 2);
    EXPECT_EQ(minimum.b.dimension, 1);
    EXPECT_EQ(dot_product(minimum.w, minimum.w), Rational(1, 8));
  }
  const std::vector<DistanceMinimum> within = minima_of(valley, ridge(1.0), 0.0);
  ASSERT_EQ(within.size(), 1U);
  EXPECT_EQ(within.front().a.dimension, 1);
  EXPECT_EQ(within.front().b.dimension, 1);
  EXPECT_TRUE(is_zero(within.front().w));
}

}  // namespace
}  // namespace ashlar::distance_minima_test
