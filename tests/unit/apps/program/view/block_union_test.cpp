#include "apps/program/view/block_union.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace ashlar::block_union_test {
namespace {

/// A triangle for each block, at x = its number + the shift.
UnstructuredGrid frame(const std::vector<int>& blocks, double shift = 0.0) {
  UnstructuredGrid grid;
  std::vector<double> speed;
  std::vector<std::int32_t> of_cell;
  for (const int block : blocks) {
    const int first = static_cast<int>(grid.points.size());
    for (const auto& [y, z] : std::array<std::array<double, 2>, 3>{{{0, 0}, {1, 0}, {0, 1}}}) {
      grid.points.emplace_back(block + shift, y, z);
      speed.push_back(10.0 * block + shift);
    }
    grid.add_cell(VtkCellType::triangle, std::array{first, first + 1, first + 2});
    of_cell.push_back(block);
  }
  grid.point_data.push_back({"speed", 1, {}, speed});
  grid.cell_data.push_back({"block", 1, {}, of_cell});
  return grid;
}

TEST(BlockUnion, BlocksThatAreNotThereHaveNoPlace) {
  BlockUnion blocks;
  blocks.add(frame({0, 2}));
  blocks.add(frame({1, 2}, 0.25));
  const UnstructuredGrid whole = blocks.whole();
  ASSERT_EQ(whole.points.size(), 9U);
  EXPECT_EQ(whole.points[0], Vector3(0, 0, 0));
  EXPECT_EQ(whole.points[3], Vector3(1.25, 0, 0)) << "as the first frame with it has it";
  EXPECT_EQ(whole.points[6], Vector3(2, 0, 0));
  const UnstructuredGrid full = blocks.completed(frame({1, 2}, 0.25));
  ASSERT_EQ(full.points.size(), 9U);
  EXPECT_EQ(full.connectivity, whole.connectivity);
  EXPECT_EQ(full.offsets, whole.offsets);
  EXPECT_TRUE(std::isnan(full.points[0].x()));
  EXPECT_EQ(full.points[3], Vector3(1.25, 0, 0));
  EXPECT_EQ(full.points[6], Vector3(2.25, 0, 0));
  const auto& speed = std::get<std::vector<double>>(full.point_data.front().values);
  ASSERT_EQ(speed.size(), 9U);
  EXPECT_TRUE(std::isnan(speed[2]));
  EXPECT_EQ(speed[3], 10.25);
  EXPECT_EQ(std::get<std::vector<std::int32_t>>(full.cell_data.front().values),
            (std::vector<std::int32_t>{0, 1, 2}));
}

TEST(BlockUnion, FramesOfARunWithoutStagesStayAsTheyAre) {
  const UnstructuredGrid grid = frame({0, 1});
  EXPECT_EQ(BlockUnion().completed(grid).points, grid.points);
  EXPECT_THROW(BlockUnion().add(frame({1, 0, 1})), std::runtime_error);
}

TEST(BlockUnion, BlocksAreInTheOrderOfTheirNumbers) {
  BlockUnion blocks;
  blocks.add(frame({1, 0}));
  blocks.add(frame({2, 1}, 0.25));
  EXPECT_EQ(blocks.whole().points[0], Vector3(0, 0, 0));
  const UnstructuredGrid full = blocks.completed(frame({2, 1}, 0.25));
  EXPECT_EQ(full.connectivity, blocks.whole().connectivity);
  EXPECT_TRUE(std::isnan(full.points[0].x()));
  EXPECT_EQ(full.points[3], Vector3(1.25, 0, 0));
  EXPECT_EQ(full.points[6], Vector3(2.25, 0, 0));
}

}  // namespace
}  // namespace ashlar::block_union_test
