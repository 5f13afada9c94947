#include "geometry/solid/half_edges.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ashlar::half_edges_test {
namespace {

using testing::ElementsAre;
using Triangles = std::vector<std::array<int, 3>>;

std::vector<std::vector<int>> edges_of(const Triangles& triangles, std::size_t point_count) {
  HalfEdges half_edges(triangles, point_count);
  half_edges.add_all();
  std::vector<std::vector<int>> edges;
  half_edges.for_each_edge(half_edges.sorted_by_edge(),
                           [&](std::span<const int> edge) { edges.emplace_back(edge.begin(), edge.end()); });
  return edges;
}

std::vector<int> twins_of(const Triangles& triangles, std::size_t point_count) {
  HalfEdges half_edges(triangles, point_count);
  half_edges.add_all();
  return half_edges.twins();
}

TEST(HalfEdges, FollowEachOtherInTheirTriangle) {
  for (const int t : {0, 7})
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(next_half_edge(3 * t + k), 3 * t + (k + 1) % 3);
      EXPECT_EQ(previous_half_edge(next_half_edge(3 * t + k)), 3 * t + k);
    }
}

TEST(HalfEdges, AreFoundUntilTheirTriangleIsRemoved) {
  const Triangles triangles = {{0, 1, 2}, {0, 2, 3}};
  HalfEdges edges(triangles, 4);
  EXPECT_EQ(edges.find(0, 1), -1);
  edges.add(0);
  edges.add(1);
  EXPECT_EQ(edges.find(0, 1), 0);
  EXPECT_EQ(edges.find(2, 0), 2);
  EXPECT_EQ(edges.find(0, 2), 3);
  EXPECT_EQ(edges.find(1, 0), -1);
  EXPECT_EQ(edges.start(2), 2);
  EXPECT_EQ(edges.end(2), 0);
  edges.remove(0);
  EXPECT_EQ(edges.find(0, 1), -1);
  EXPECT_EQ(edges.find(0, 2), 3);
  EXPECT_EQ(edges.first(0), 3);
  EXPECT_EQ(edges.next(3), -1);
}

// Edges 0-1, 0-2, 1-2, 1-3, 2-3; half-edges 1 (from 1 to 2) and 5 (from 2 to 1) share the third.
TEST(HalfEdges, AreSortedByTheEndsOfTheirEdges) {
  EXPECT_THAT(edges_of({{0, 1, 2}, {1, 3, 2}}, 4),
              ElementsAre(ElementsAre(0), ElementsAre(2), ElementsAre(1, 5), ElementsAre(3), ElementsAre(4)));
  // Added in another order, by other triangles: numbers of half-edges decide within an edge.
  EXPECT_THAT(edges_of({{1, 3, 2}, {0, 1, 2}}, 4),
              ElementsAre(ElementsAre(3), ElementsAre(5), ElementsAre(2, 4), ElementsAre(0), ElementsAre(1)));
}

TEST(HalfEdges, ATetrahedronHasTwinsAllAround) {
  // 0-1: 2 and 6, 0-2: 0 and 5, 0-3: 3 and 8, 1-2: 1 and 9, 1-3: 7 and 11, 2-3: 4 and 10.
  const Triangles triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  EXPECT_THAT(twins_of(triangles, 4), ElementsAre(5, 9, 6, 8, 10, 0, 2, 11, 3, 1, 4, 7));
}

TEST(HalfEdges, OnlyTwoInOppositeDirectionsAreTwins) {
  EXPECT_THAT(twins_of({{0, 1, 2}, {1, 2, 3}}, 4), testing::Each(-1));             // the same direction
  EXPECT_THAT(twins_of({{0, 1, 2}, {2, 1, 3}, {2, 1, 4}}, 5), testing::Each(-1));  // three triangles
  EXPECT_THAT(twins_of({{0, 1, 2}, {2, 1, 3}}, 4), ElementsAre(-1, 3, -1, 1, -1, -1));
}

TEST(HalfEdges, TrianglesThatNameAPointTwiceHaveNone) {
  EXPECT_TRUE(edges_of({{0, 1, 1}, {2, 0, 2}, {1, 1, 1}}, 3).empty());
  EXPECT_THAT(twins_of({{0, 0, 1}, {0, 1, 2}, {1, 0, 2}}, 3), ElementsAre(-1, -1, -1, 6, 8, 7, 3, 5, 4));
}

}  // namespace
}  // namespace ashlar::half_edges_test
