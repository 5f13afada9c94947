#include "apps/program/view/curved_cells.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

#include "apps/results/frames/lagrange_triangle.hpp"

namespace ashlar::curved_cells_test {
namespace {

/// Block 3: the triangle (0,0) (1,0) (0,1) of order 2, lifted to z = x^2 - x y, with a field 1 + y^2; block
/// 1: a square.
UnstructuredGrid frame() {
  UnstructuredGrid grid;
  std::vector<double> displacement;
  std::vector<double> field;
  const auto add = [&](double x, double y) {
    const double z = x * x - x * y;
    grid.points.emplace_back(x, y, z);
    displacement.insert(displacement.end(), {0.0, 0.0, z});
    field.push_back(1.0 + y * y);
  };
  add(9.0, 9.0);  // used by no cell
  for (const LatticeWeights& node : lagrange_nodes(2)) add(0.5 * node[1], 0.5 * node[2]);
  for (const auto& [x, y] : std::array<std::array<double, 2>, 4>{{{0, 2}, {1, 2}, {1, 3}, {0, 3}}}) add(x, y);
  grid.add_cell(VtkCellType::lagrange_triangle, std::array{1, 2, 3, 4, 5, 6});
  grid.add_cell(VtkCellType::polygon, std::array{7, 8, 9, 10});
  grid.point_data.push_back({"displacement", 3, {}, displacement});
  grid.point_data.push_back({"field", 1, {}, field});
  grid.cell_data.push_back({"block", 1, {}, std::vector<std::int32_t>{3, 1}});
  grid.cell_data.push_back({"size", 1, {}, std::vector<double>{0.5, 1.0}});
  return grid;
}

TEST(CurvedCells, SmallTrianglesLieOnThePolynomial) {
  const UnstructuredGrid grid = frame();
  const UnstructuredGrid divided = CurvedCells(grid).divided(grid);
  validate(divided);
  // 8 pieces along the longest side, which is the diagonal of the box around the flat triangle.
  ASSERT_EQ(divided.types.size(), 64U + 1U);
  ASSERT_EQ(divided.points.size(), 45U + 4U);
  const auto& field = std::get<std::vector<double>>(divided.point_data[1].values);
  for (std::size_t i = 0; i < divided.points.size(); ++i) {
    const Vector3& place = divided.points[i];
    EXPECT_NEAR(place.z(), place.x() * place.x() - place.x() * place.y(), 1e-14);
    EXPECT_NEAR(field[i], 1.0 + place.y() * place.y(), 1e-14);
  }
}

TEST(CurvedCells, CellDataFollow) {
  const UnstructuredGrid grid = frame();
  const UnstructuredGrid divided = CurvedCells(grid).divided(grid);
  const auto& block = std::get<std::vector<std::int32_t>>(divided.cell_data[0].values);
  const auto& size = std::get<std::vector<double>>(divided.cell_data[1].values);
  int squares = 0;
  for (std::size_t c = 0; c < divided.types.size(); ++c) {
    const bool square = divided.types[c] == VtkCellType::polygon;
    squares += square ? 1 : 0;
    EXPECT_EQ(block[c], square ? 1 : 3);
    EXPECT_EQ(size[c], square ? 1.0 : 0.5);
  }
  EXPECT_EQ(squares, 1);
}

TEST(CurvedCells, FramesWithoutStayAsTheyAre) {
  UnstructuredGrid grid;
  grid.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
  grid.add_cell(VtkCellType::triangle, std::array{0, 1, 2});
  const UnstructuredGrid same = CurvedCells(grid).divided(grid);
  EXPECT_EQ(same.points, grid.points);
  EXPECT_EQ(same.connectivity, grid.connectivity);
}

TEST(CurvedCells, RefusesOtherCells) {
  const UnstructuredGrid grid = frame();
  UnstructuredGrid other = grid;
  other.connectivity[0] = 0;
  EXPECT_THROW((void)CurvedCells(grid).divided(other), std::runtime_error);
  UnstructuredGrid five = grid;
  five.offsets[0] = 5;
  EXPECT_THROW(CurvedCells{five}, std::runtime_error);
  UnstructuredGrid nameless = grid;
  nameless.cell_data.clear();
  EXPECT_THROW(CurvedCells{nameless}, std::runtime_error);
}

}  // namespace
}  // namespace ashlar::curved_cells_test
