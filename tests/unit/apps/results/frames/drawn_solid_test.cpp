#include "apps/results/frames/drawn_solid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <memory>

#include "geometry/solid/shapes.hpp"
#include "support/sample_meshes.hpp"

namespace ashlar::drawn_solid_test {
namespace {

BlockModel block(const TriangleMesh& mesh, int order, bool fixed = false) {
  BlockDefinition definition;
  definition.solid = std::make_shared<const Polyhedron>(mesh);
  definition.material = {.density = 1000.0, .young_modulus = 1e9, .poisson_ratio = 0.25};
  definition.order = order;
  definition.fixed = fixed;
  return BlockModel(definition);
}

double volume_of(const DrawnSolid& solid) {
  double sum = 0.0;
  for (const auto& cell : solid.cells) {
    const auto corner = [&](std::size_t k) { return solid.points[static_cast<std::size_t>(cell[k])]; };
    const double part = (corner(1) - corner(0)).cross(corner(2) - corner(0)).dot(corner(3) - corner(0)) / 6.0;
    EXPECT_GT(part, 0.0);
    sum += part;
  }
  return sum;
}

const TriangleMesh cube = make_box({0, 0, 0}, {1, 1, 1});

TEST(DrawnSolids, BlocksThatStayAffineHaveWholeTetrahedra) {
  for (const bool lagrange : {false, true}) {
    const auto solids = drawn_solids({block(cube, 1), block(cube, 0), block(cube, 3, true)}, lagrange);
    ASSERT_EQ(solids.size(), 3U);
    for (const DrawnSolid& solid : solids) {
      EXPECT_EQ(solid.type, VtkCellType::tetrahedron);
      EXPECT_EQ(solid.points.size(), 9U);
      EXPECT_EQ(solid.cells.size(), 12U);
      EXPECT_NEAR(volume_of(solid), 1.0, 1e-14);
    }
  }
}

TEST(DrawnSolids, BlocksThatBendAreDivided) {
  const DrawnSolid solid = drawn_solids({block(cube, 2)}, false).front();
  // 7 pieces as of its surface: 12 * 7^3.
  EXPECT_EQ(solid.cells.size(), 4116U);
  EXPECT_NEAR(volume_of(solid), 1.0, 1e-12);
}

TEST(DrawnSolids, ManyBlocksAreDividedLess) {
  // 40 blocks of 12 tetrahedra: 12 * 40 * 5^3 = 60 000, with 6^3 103 680.
  const auto solids = drawn_solids(std::vector(40, block(cube, 2)), false);
  EXPECT_EQ(solids.front().cells.size(), 12U * 125U);
}

TEST(DrawnSolids, LagrangeTetrahedraHaveTheOrderOfTheBlock) {
  const DrawnSolid solid = drawn_solids({block(cube, 3)}, true).front();
  EXPECT_EQ(solid.type, VtkCellType::lagrange_tetrahedron);
  ASSERT_EQ(solid.cells.size(), 12U);
  for (const auto& cell : solid.cells) EXPECT_EQ(cell.size(), 20U);
  // 9 corners; 12 sides of the cube, 6 diagonals, 8 to the middle: 26 sides with 2 points; 12 + 18 faces with one.
  EXPECT_EQ(solid.points.size(), 9U + 26U * 2U + 30U);
}

TEST(DrawnSolids, TranslatedBlocksAreTheSameElsewhere) {
  TriangleMesh far = test_support::make_frame();
  for (Vector3& point : far.points) point += Vector3(16, -8, 4);
  const auto solids = drawn_solids({block(test_support::make_frame(), 1), block(far, 1)}, false);
  ASSERT_EQ(solids[0].points.size(), solids[1].points.size());
  EXPECT_EQ(solids[0].cells, solids[1].cells);
  for (std::size_t k = 0; k < solids[0].points.size(); ++k)
    EXPECT_NEAR((solids[1].points[k] - solids[0].points[k] - Vector3(16, -8, 4)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(volume_of(solids[1]), 8.0, 1e-12);
}

}  // namespace
}  // namespace ashlar::drawn_solid_test
