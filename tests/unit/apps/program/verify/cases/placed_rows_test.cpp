#include "apps/program/verify/cases/placed_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "apps/results/columns/contact_columns.hpp"
#include "apps/results/columns/history_columns.hpp"

namespace ashlar::placed_rows_test {
namespace {

/// A quarter turn about z and (1, 2, 3): (x, y, z) -> (1 - y, 2 + x, 3 + z).
Placement quarter_turn() {
  Placement placement;
  placement.turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  placement.shift = {1, 2, 3};
  return placement;
}

std::vector<Column> columns_of_block() {
  Measure cube;
  cube.name = "cube";
  cube.kind = Measure::Kind::block;
  return history_columns({cube});
}

std::size_t index_of(const std::string& name) {
  const std::vector<std::string> names = names_of(columns_of_block());
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// A row of zeros with some values.
std::vector<double> row_with(const std::vector<std::pair<std::string, double>>& values) {
  std::vector<double> row(columns_of_block().size(), 0.0);
  for (const auto& [name, value] : values) row.at(index_of(name)) = value;
  return row;
}

TEST(PlacedRows, VectorsPlacesAndTensors) {
  const std::vector<double> there = row_with({{"cube.x", -4},
                                              {"cube.y", 6},
                                              {"cube.z", 9},
                                              {"cube.ux", -5},
                                              {"cube.uy", 4},
                                              {"cube.rz", 90},
                                              {"cube.rx", 1},
                                              {"cube.vy", 7},
                                              {"momentum.x", -5},
                                              {"momentum.y", 4},
                                              {"cube.sxx", 2},
                                              {"cube.syy", 1},
                                              {"cube.szz", 3},
                                              {"cube.sxy", -4},
                                              {"cube.syz", 6},
                                              {"cube.sxz", -5},
                                              {"time", 2},
                                              {"energy.kinetic", 8},
                                              {"cube.speed", 9}});
  const std::vector<double> here = row_with({{"cube.x", 4},
                                             {"cube.y", 5},
                                             {"cube.z", 6},
                                             {"cube.ux", 4},
                                             {"cube.uy", 5},
                                             {"cube.rz", 90},
                                             {"cube.ry", -1},
                                             {"cube.vx", 7},
                                             {"momentum.x", 4},
                                             {"momentum.y", 5},
                                             {"cube.sxx", 1},
                                             {"cube.syy", 2},
                                             {"cube.szz", 3},
                                             {"cube.sxy", 4},
                                             {"cube.syz", 5},
                                             {"cube.sxz", 6},
                                             {"time", 2},
                                             {"energy.kinetic", 8},
                                             {"cube.speed", 9}});
  EXPECT_EQ(turned_back(columns_of_block(), {there}, quarter_turn(), Vector3::Zero()),
            std::vector<std::vector<double>>{here});
}

/// A momentum (0, 5, 0) at (2, 0, 0) has (0, 0, 10) about the origin. Turned it is (-5, 0, 0) at (1, 4, 3).
TEST(PlacedRows, AngularMomentumIsAboutTheOwnOrigin) {
  const std::vector<double> there = row_with({{"cube.x", 1},
                                              {"cube.y", 2},
                                              {"cube.z", 3},
                                              {"momentum.x", -5},
                                              {"angular_momentum.x", 0},
                                              {"angular_momentum.y", -15},
                                              {"angular_momentum.z", 20}});
  const std::vector<double> here = row_with({{"momentum.y", 5}, {"angular_momentum.z", 10}});
  EXPECT_EQ(turned_back(columns_of_block(), {there}, quarter_turn(), quarter_turn().shift),
            std::vector<std::vector<double>>{here});
}

/// Components follow each other, which turned_back relies on.
TEST(PlacedRows, ColumnsHaveAllComponentsInOrder) {
  std::vector<MeasureColumns> tables = columns_by_kind();
  tables.push_back({"contacts", contact_columns()});
  const std::vector<std::string> vector = {"x", "y", "z"}, tensor = {"xx", "yy", "zz", "xy", "yz", "xz"};
  std::size_t components = 0;
  for (const auto& [kind, columns] : tables) {
    for (std::size_t k = 0; k < columns.size();) {
      if (columns[k].component.empty()) {
        ++k;
        continue;
      }
      const std::vector<std::string>& all = columns[k].component == "x" ? vector : tensor;
      for (const std::string& component : all) {
        ASSERT_LT(k, columns.size());
        EXPECT_EQ(columns[k].component, component) << columns[k].name;
        EXPECT_TRUE(columns[k].name.ends_with(component)) << columns[k].name;
        ++components;
        ++k;
      }
    }
  }
  // Of the run 6; of a block 12 and 6, of a point 9 and 6; of a drift 3; of contacts 6.
  EXPECT_EQ(components, 48U);
}

}  // namespace
}  // namespace ashlar::placed_rows_test
