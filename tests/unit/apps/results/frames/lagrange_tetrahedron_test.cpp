#include "apps/results/frames/lagrange_tetrahedron.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <map>
#include <set>
#include <stdexcept>

namespace ashlar::lagrange_tetrahedron_test {
namespace {

using ::testing::ElementsAre;
using Node = TetrahedronWeights;

TEST(LagrangeTetrahedron, CornersThenSides) {
  EXPECT_THAT(tetrahedron_nodes(1),
              ElementsAre(Node{1, 0, 0, 0}, Node{0, 1, 0, 0}, Node{0, 0, 1, 0}, Node{0, 0, 0, 1}));
  // VTK's quadratic tetrahedron: sides 01, 12, 20, 03, 13, 23.
  EXPECT_THAT(
      tetrahedron_nodes(2),
      ElementsAre(Node{2, 0, 0, 0}, Node{0, 2, 0, 0}, Node{0, 0, 2, 0}, Node{0, 0, 0, 2}, Node{1, 1, 0, 0},
                  Node{0, 1, 1, 0}, Node{1, 0, 1, 0}, Node{1, 0, 0, 1}, Node{0, 1, 0, 1}, Node{0, 0, 1, 1}));
  EXPECT_THROW((void)tetrahedron_nodes(0), std::invalid_argument);
}

TEST(LagrangeTetrahedron, EveryLatticePointOnce) {
  for (int order = 1; order <= 12; ++order) {
    const auto nodes = tetrahedron_nodes(order);
    EXPECT_EQ(nodes.size(), static_cast<std::size_t>((order + 1) * (order + 2) * (order + 3) / 6));
    EXPECT_EQ(std::set(nodes.begin(), nodes.end()).size(), nodes.size());
    for (const auto& [i, j, k, l] : nodes) EXPECT_EQ(i + j + k + l, order);
  }
}

TEST(LagrangeTetrahedron, SmallTetrahedraFillItWithItsOrientation) {
  for (const int pieces : {1, 2, 3, 6}) {
    const auto nodes = tetrahedron_nodes(pieces);
    const auto cells = lattice_tetrahedra(pieces);
    EXPECT_EQ(cells.size(), static_cast<std::size_t>(pieces * pieces * pieces));
    std::map<std::set<int>, int> faces;
    for (const auto& cell : cells) {
      Eigen::Matrix3i sides;
      for (int k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis)
          sides(k, axis) = nodes[static_cast<std::size_t>(cell[static_cast<std::size_t>(k) + 1])]
                                [static_cast<std::size_t>(axis) + 1] -
                           nodes[static_cast<std::size_t>(cell[0])][static_cast<std::size_t>(axis) + 1];
      // Six times the volume in lattice units; pieces^3 of 1 make up the whole.
      EXPECT_EQ(sides.determinant(), 1);
      for (const int left_out : cell) {
        std::set<int> face(cell.begin(), cell.end());
        face.erase(left_out);
        ++faces[face];
      }
    }
    // They meet in whole faces; what is free are pieces^2 triangles of each side.
    int free = 0;
    for (const auto& [face, count] : faces) {
      EXPECT_LE(count, 2);
      free += count == 1 ? 1 : 0;
    }
    EXPECT_EQ(free, 4 * pieces * pieces);
  }
}

TEST(SimplexLattice, NeighboursShareTheirFace) {
  const auto nodes = tetrahedron_nodes(4);
  const auto lattice = simplex_lattice<4>({{0, 1, 2, 3}, {4, 3, 2, 1}}, nodes);
  // 35 points each, 15 on the common face.
  EXPECT_EQ(lattice.points.size(), 35U + 35U - 15U);
}

}  // namespace
}  // namespace ashlar::lagrange_tetrahedron_test
