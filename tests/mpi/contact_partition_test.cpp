#include "solver/ranks/mpi/contact_partition.hpp"

#include <gtest/gtest.h>

#include "tests/mpi/test_ranks.hpp"

namespace ashlar::contact_partition_test {
namespace {

/// Blocks of a grid of columns and rows, each in contact with those beside. @param owners rank that knows a block
std::vector<PartitionBlock> grid_of_blocks(int columns, int rows, const std::vector<int>& owners) {
  std::vector<PartitionBlock> blocks;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int block = row * columns + column;
      if (owners[static_cast<std::size_t>(block)] != test_ranks().own()) continue;
      PartitionBlock& known = blocks.emplace_back();
      known.block = block;
      known.weight = weight_of_block(12, 16);
      known.centroid = Eigen::Vector3d(column, 0.0, row);
      if (row > 0) known.neighbours.push_back(block - columns);
      if (column > 0) known.neighbours.push_back(block - 1);
      if (column + 1 < columns) known.neighbours.push_back(block + 1);
      if (row + 1 < rows) known.neighbours.push_back(block + columns);
      known.points.assign(known.neighbours.size(), 4);
    }
  }
  return blocks;
}

int contacts_between_ranks(int columns, int rows, const std::vector<int>& owners) {
  int contacts = 0;
  const auto owner = [&](int column, int row) {
    return owners[static_cast<std::size_t>(row * columns + column)];
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      if (column + 1 < columns && owner(column, row) != owner(column + 1, row)) ++contacts;
      if (row + 1 < rows && owner(column, row) != owner(column, row + 1)) ++contacts;
    }
  }
  return contacts;
}

std::vector<int> shuffled_owners(int blocks) {
  std::vector<int> owners;
  for (int block = 0; block < blocks; ++block) owners.push_back(block * 7 % 11 % test_ranks().count());
  return owners;
}

TEST(ContactPartition, CutsFewContactsAndSharesWork) {
  const int columns = 24, rows = 12, ranks = test_ranks().count();
  const std::vector<int> known = shuffled_owners(columns * rows);
  const std::vector<int> owners =
      partition_by_contact(test_ranks(), grid_of_blocks(columns, rows, known), columns * rows);
  const std::vector<double> weights(owners.size(), 1.0);
  EXPECT_LT(imbalance_of(owners, weights, ranks), 0.05);
  // Straight cuts: none; one of 12; a cross of 12 + 24, or three of 12. A cut along bricks may be half as long again.
  const int straight = ranks == 1 ? 0 : ranks == 2 ? 12 : 36;
  EXPECT_LE(contacts_between_ranks(columns, rows, owners), straight + straight / 2);
  // The same question has the same answer.
  for (int repeat = 0; repeat < 3; ++repeat)
    EXPECT_EQ(partition_by_contact(test_ranks(), grid_of_blocks(columns, rows, known), columns * rows),
              owners);
}

TEST(ContactPartition, FewBlocksMoveFromAGoodPartition) {
  const int columns = 20, rows = 8;
  const int ranks = test_ranks().count();
  std::vector<int> present;
  // Parts from right to left.
  for (int block = 0; block < columns * rows; ++block)
    present.push_back((columns - 1 - block % columns) * ranks / columns);
  const std::vector<int> owners =
      partition_by_contact(test_ranks(), grid_of_blocks(columns, rows, present), columns * rows);
  int moved = 0;
  for (std::size_t k = 0; k < owners.size(); ++k) moved += owners[k] != present[k] ? 1 : 0;
  // Wherever the cuts are, names are those that keep most: at least the part that a rank has in common with one.
  EXPECT_LE(moved, columns * rows * (ranks - 1) / ranks);
  if (ranks == 2) {
    EXPECT_LE(moved, columns * rows / 4);
  }
}

TEST(ContactPartition, WithoutContactsByPlace) {
  const std::vector<int> known = shuffled_owners(40);
  std::vector<PartitionBlock> blocks = grid_of_blocks(10, 4, known);
  for (PartitionBlock& block : blocks) {
    block.neighbours.clear();
    block.points.clear();
  }
  EXPECT_EQ(partition_by_contact(test_ranks(), blocks, 40), partition_by_place(test_ranks(), blocks, 40));
}

}  // namespace
}  // namespace ashlar::contact_partition_test
