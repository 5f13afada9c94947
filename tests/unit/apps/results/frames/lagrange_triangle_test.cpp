#include "apps/results/frames/lagrange_triangle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

namespace ashlar::lagrange_triangle_test {
namespace {

using ::testing::ElementsAre;

std::array<double, 3> share_of(const LatticeWeights& weights, int order) {
  return {static_cast<double>(weights[0]) / order, static_cast<double>(weights[1]) / order,
          static_cast<double>(weights[2]) / order};
}

TEST(LagrangeTriangle, CornersSidesThenInside) {
  using Node = LatticeWeights;
  EXPECT_THAT(lagrange_nodes(1), ElementsAre(Node{1, 0, 0}, Node{0, 1, 0}, Node{0, 0, 1}));
  EXPECT_THAT(lagrange_nodes(2), ElementsAre(Node{2, 0, 0}, Node{0, 2, 0}, Node{0, 0, 2}, Node{1, 1, 0},
                                             Node{0, 1, 1}, Node{1, 0, 1}));
  EXPECT_THAT(lagrange_nodes(3),
              ElementsAre(Node{3, 0, 0}, Node{0, 3, 0}, Node{0, 0, 3}, Node{2, 1, 0}, Node{1, 2, 0},
                          Node{0, 2, 1}, Node{0, 1, 2}, Node{1, 0, 2}, Node{2, 0, 1}, Node{1, 1, 1}));
  // Inside a triangle of order 5 lies one of order 2.
  const auto five = lagrange_nodes(5);
  EXPECT_THAT(
      std::vector(five.begin() + 15, five.end()),
      ElementsAre(Node{3, 1, 1}, Node{1, 3, 1}, Node{1, 1, 3}, Node{2, 2, 1}, Node{1, 2, 2}, Node{2, 1, 2}));
  EXPECT_THROW((void)lagrange_nodes(0), std::invalid_argument);
}

TEST(LagrangeTriangle, EveryLatticePointOnce) {
  for (int order = 1; order <= 12; ++order) {
    const auto nodes = lagrange_nodes(order);
    EXPECT_EQ(nodes.size(), static_cast<std::size_t>((order + 1) * (order + 2) / 2));
    EXPECT_EQ(std::set(nodes.begin(), nodes.end()).size(), nodes.size());
    for (const auto& [i, j, k] : nodes) EXPECT_EQ(i + j + k, order);
  }
}

TEST(LagrangeTriangle, ShapeFunctionsAreOneAtTheirNodeOnly) {
  for (const int order : {1, 2, 5}) {
    const auto nodes = lagrange_nodes(order);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const auto values = lagrange_values(order, share_of(nodes[a], order));
      for (std::size_t b = 0; b < nodes.size(); ++b) EXPECT_NEAR(values[b], a == b ? 1.0 : 0.0, 1e-13);
    }
  }
}

TEST(LagrangeTriangle, PolynomialsOfTheOrderComeBack) {
  for (int order = 1; order <= 12; ++order) {
    const auto nodes = lagrange_nodes(order);
    const std::array<double, 3> share = {0.21, 0.3, 0.49};
    const auto values = lagrange_values(order, share);
    for (int power = 0; power <= order; ++power) {
      double sum = 0.0;
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        const auto at = share_of(nodes[a], order);
        sum += values[a] * std::pow(at[1], power) * std::pow(at[2], order - power);
      }
      EXPECT_NEAR(sum, std::pow(share[1], power) * std::pow(share[2], order - power), 1e-13) << order;
    }
  }
}

TEST(LagrangeTriangle, SmallTrianglesCoverItWithItsOrientation) {
  for (const int order : {1, 2, 7}) {
    const auto nodes = lagrange_nodes(order);
    const auto triangles = lattice_triangles(order);
    EXPECT_EQ(triangles.size(), static_cast<std::size_t>(order * order));
    for (const auto& triangle : triangles) {
      std::array<LatticeWeights, 3> corner;
      for (std::size_t k = 0; k < 3; ++k) corner[k] = nodes[static_cast<std::size_t>(triangle[k])];
      // Twice the area in lattice units; order^2 of 1 make up the whole.
      const int area = (corner[1][1] - corner[0][1]) * (corner[2][2] - corner[0][2]) -
                       (corner[1][2] - corner[0][2]) * (corner[2][1] - corner[0][1]);
      EXPECT_EQ(area, 1);
    }
  }
}

TEST(SharedLattice, NeighboursShareTheirSide) {
  const SharedLattice lattice = shared_lattice({{7, 2, 4}, {2, 9, 4}}, 4);
  EXPECT_EQ(lattice.points.size(), 15U + 15U - 5U);
  const auto nodes = lagrange_nodes(4);
  std::vector<int> seen_from_first(5);
  std::vector<int> seen_from_second(5);
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    // The side from corner 2 to corner 4 is B to C of the first and A to C of the second.
    if (nodes[a][0] == 0) seen_from_first[static_cast<std::size_t>(nodes[a][2])] = lattice.nodes[0][a];
    if (nodes[a][1] == 0) seen_from_second[static_cast<std::size_t>(nodes[a][2])] = lattice.nodes[1][a];
  }
  EXPECT_EQ(seen_from_first, seen_from_second);
  EXPECT_EQ(lattice.points[static_cast<std::size_t>(seen_from_second[1])].cell, 0U);
}

}  // namespace
}  // namespace ashlar::lagrange_triangle_test
