#include "apps/results/frames/drawn_surface.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "geometry/solid/shapes.hpp"

namespace ashlar::drawn_surface_test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

BlockModel cube(int order, bool fixed = false, Formulation formulation = Formulation::total) {
  BlockDefinition definition;
  definition.solid = std::make_shared<const Polyhedron>(make_box({0, 0, 0}, {1, 1, 1}));
  definition.material = {.density = 1000.0, .young_modulus = 1e9, .poisson_ratio = 0.25};
  definition.order = order;
  definition.fixed = fixed;
  definition.formulation = formulation;
  definition.sub_face_levels = 1;
  return BlockModel(definition);
}

CurvedTriangles cube_triangles(int order) {
  const TriangleMesh mesh = make_box({0, 0, 0}, {1, 1, 1});
  CurvedTriangles triangles{order, mesh.points, {}};
  for (const auto& triangle : mesh.triangles)
    triangles.corners.push_back({triangle[0], triangle[1], triangle[2]});
  return triangles;
}

std::size_t triangles_of(const DrawnSurface& surface) {
  return static_cast<std::size_t>(std::count_if(
      surface.cells.begin(), surface.cells.end(),
      [](const auto& cell) { return cell.type == VtkCellType::triangle && cell.points.size() == 3; }));
}

double area_of_triangles(const DrawnSurface& surface) {
  double area = 0.0;
  for (const auto& cell : surface.cells) {
    const auto corner = [&](std::size_t k) {
      return surface.points[static_cast<std::size_t>(cell.points[k])];
    };
    area += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  }
  return area;
}

TEST(PiecesOfSides, GrowWithTheOrderUpToFour) {
  // The longest side of a cube is sqrt(2) / sqrt(3) of its diagonal: 8, 12, 16, 16 times 0.8165, rounded up.
  std::vector<int> pieces;
  for (const int order : {2, 3, 4, 9}) pieces.push_back(pieces_of_sides({cube_triangles(order)}).front());
  EXPECT_THAT(pieces, ElementsAre(7, 10, 14, 14));
}

TEST(PiecesOfSides, FewerForManyBlocks) {
  // 1200 triangles with p^2 pieces each: p is 5 at most.
  EXPECT_THAT(pieces_of_sides(std::vector(100, cube_triangles(2))), Each(5));
  // Already more triangles than are to be drawn.
  EXPECT_THAT(pieces_of_sides(std::vector(4000, cube_triangles(2))), Each(1));
}

TEST(DrawnSurfaces, BlocksThatStayAffineHaveWholeFaces) {
  for (const bool lagrange : {false, true}) {
    const auto surfaces = drawn_surfaces({cube(1), cube(3, true)}, lagrange);
    ASSERT_EQ(surfaces.size(), 2U);
    for (const DrawnSurface& surface : surfaces) {
      EXPECT_EQ(surface.points.size(), 8U);
      EXPECT_EQ(surface.cells.size(), 6U);
      for (const auto& cell : surface.cells) EXPECT_EQ(cell.type, VtkCellType::polygon);
    }
  }
}

TEST(DrawnSurfaces, BlocksThatCurveAreDivided) {
  const DrawnSurface surface = drawn_surfaces({cube(2)}, false).front();
  EXPECT_EQ(surface.cells.size(), 12U * 49U);
  EXPECT_EQ(triangles_of(surface), surface.cells.size());
  // Euler: a closed surface has V = 2 + F / 2 corners.
  EXPECT_EQ(surface.points.size(), 2U + surface.cells.size() / 2U);
  EXPECT_NEAR(area_of_triangles(surface), 6.0, 1e-12);
}

TEST(DrawnSurfaces, LagrangeTrianglesHaveTheOrderOfTheBlock) {
  const DrawnSurface surface = drawn_surfaces({cube(3)}, true).front();
  EXPECT_EQ(surface.cells.size(), 12U);
  for (const auto& cell : surface.cells) {
    EXPECT_EQ(cell.type, VtkCellType::lagrange_triangle);
    EXPECT_EQ(cell.points.size(), 10U);
  }
  // 8 corners, 18 sides with 2 inner points each, 12 points inside.
  EXPECT_EQ(surface.points.size(), 8U + 36U + 12U);
}

TEST(DrawnSurfaces, IncrementalBlocksKeepTheirSubFaces) {
  const DrawnSurface surface = drawn_surfaces({cube(2, false, Formulation::incremental)}, true).front();
  EXPECT_EQ(triangles_of(surface), 48U);
}

}  // namespace
}  // namespace ashlar::drawn_surface_test
