// VTK's own reader checks the contents of the files, tests/vtk/read_samples.py.
#include "apps/results/frames/vtu/vtu_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <ostream>
#include <stdexcept>

#include "support/temporary_folder.hpp"

namespace ashlar::vtu_writer_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

UnstructuredGrid triangle_grid() {
  UnstructuredGrid grid;
  grid.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  grid.add_cell(VtkCellType::triangle, std::array{0, 1, 2});
  return grid;
}

TEST(UnstructuredGrid, AddCellKeepsTheThreeListsTogether) {
  UnstructuredGrid grid = triangle_grid();
  grid.add_cell(VtkCellType::vertex, std::array{2});
  EXPECT_EQ(grid.connectivity, (std::vector{0, 1, 2, 2}));
  EXPECT_EQ(grid.offsets, (std::vector{3, 4}));
  EXPECT_EQ(grid.types, (std::vector{VtkCellType::triangle, VtkCellType::vertex}));
}

struct BadGrid {
  const char* message;
  std::function<void(UnstructuredGrid&)> spoil;
};

void PrintTo(const BadGrid& bad, std::ostream* out) {
  *out << bad.message;
}

class VtuRefuses : public testing::TestWithParam<BadGrid> {};

TEST_P(VtuRefuses, WithAReason) {
  UnstructuredGrid grid = triangle_grid();
  EXPECT_NO_THROW(static_cast<void>(to_vtu(grid)));
  GetParam().spoil(grid);
  EXPECT_THAT([&] { return to_vtu(grid); },
              ThrowsMessage<std::invalid_argument>(HasSubstr(GetParam().message)));
}

INSTANTIATE_TEST_SUITE_P(
    All, VtuRefuses,
    testing::Values(BadGrid{"names point 3 of 3", [](UnstructuredGrid& g) { g.connectivity[0] = 3; }},
                    BadGrid{"names point -1 of 3", [](UnstructuredGrid& g) { g.connectivity[0] = -1; }},
                    BadGrid{"the cells end at 2", [](UnstructuredGrid& g) { g.offsets[0] = 2; }},
                    BadGrid{"cell offset -1 after 0", [](UnstructuredGrid& g) { g.offsets[0] = -1; }},
                    BadGrid{"1 cell offsets for 2 cell types",
                            [](UnstructuredGrid& g) { g.types.push_back(VtkCellType::vertex); }},
                    BadGrid{"point array 'p': 2 values, 3 x 1 needed",
                            [](UnstructuredGrid& g) {
                              g.point_data.push_back({"p", 1, {}, std::vector<double>{1, 2}});
                            }},
                    BadGrid{"cell array 'c': 1 component names for 3 components",
                            [](UnstructuredGrid& g) {
                              g.cell_data.push_back({"c", 3, {"x"}, std::vector<std::int32_t>{1, 2, 3}});
                            }},
                    BadGrid{"cell array 'c': fewer than one component",
                            [](UnstructuredGrid& g) {
                              g.cell_data.push_back({"c", 0, {}, std::vector<double>{}});
                            }},
                    BadGrid{"cell array 'c': the name is used twice", [](UnstructuredGrid& g) {
                              g.cell_data.assign(2, {"c", 1, {}, std::vector<double>{1}});
                            }}));

TEST(WriteVtu, WritesTheBytesAndNothingElse) {
  const TemporaryFolder folder;
  write_vtu(folder / "a.vtu", triangle_grid());
  EXPECT_EQ(read_text(folder / "a.vtu"), to_vtu(triangle_grid()));
  EXPECT_EQ(folder.entry_count(), 1U);
  EXPECT_THROW(write_vtu(folder / "none/a.vtu", triangle_grid()), std::runtime_error);
}

// zlib shortens equal values best; an uncompressed file would hold all 8 bytes of each.
TEST(WriteVtu, Compresses) {
  UnstructuredGrid grid;
  grid.points.assign(100000, Vector3(1, 2, 3));
  EXPECT_LT(to_vtu(grid).size(), 100000U);
}

}  // namespace
}  // namespace ashlar::vtu_writer_test
