#include "solver/linear/block_graph.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "support/random_blocks.hpp"

namespace ashlar::block_graph_test {
namespace {

using testing::ElementsAre;

TEST(BlockGraph, ListsEachPairForBothBlocks) {
  const BlockMatrix blocks({2, 3, 1, 2}, {{0, 2}, {1, 2}, {0, 1}});
  const BlockGraph graph = graph_of(blocks.matrix(), {2, 3, 1, 2});
  EXPECT_EQ(graph.blocks(), 4);
  EXPECT_THAT(graph.of(0), ElementsAre(1, 2));
  EXPECT_THAT(graph.of(1), ElementsAre(0, 2));
  EXPECT_THAT(graph.of(2), ElementsAre(0, 1));
  EXPECT_THAT(graph.of(3), ElementsAre());
  EXPECT_THAT(first_unknowns(graph.sizes), ElementsAre(0, 2, 5, 6, 8));
}

TEST(BlockGraph, RefusesBlocksThatAreNotDense) {
  // An arrow of three unknowns: as blocks of 1 and 2 its second block lacks an entry.
  SymmetricMatrix arrow{3, {0, 3, 4, 5}, {0, 1, 2, 1, 2}, {4, 1, 1, 4, 4}};
  EXPECT_THAT(graph_of(arrow, {1, 1, 1}).of(0), ElementsAre(1, 2));
  EXPECT_THROW((void)graph_of(arrow, {1, 2}), std::invalid_argument);
  EXPECT_THROW((void)graph_of(arrow, {1, 1}), std::invalid_argument);
  EXPECT_THROW((void)graph_of(arrow, {2, 1}), std::invalid_argument);
}

TEST(BlockGraph, DissectsInTheSameOrderEachTime) {
  const std::vector<int> sizes(900, 1);
  const BlockMatrix blocks(sizes, pairs_of_grid({30, 30, 1}));
  const BlockGraph graph = graph_of(blocks.matrix(), sizes);
  const std::vector<int> order = nested_dissection(graph);
  std::vector<int> all(900);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_THAT(order, testing::UnorderedElementsAreArray(all));
  (void)nested_dissection(graph_of(BlockMatrix({1, 1}, {{0, 1}}).matrix(), {1, 1}));
  EXPECT_EQ(nested_dissection(graph), order);
  // The last blocks separate the grid: a line of 30, of which METIS finds nearly the shortest.
  std::vector<bool> removed(900, false);
  for (std::size_t k = 860; k < 900; ++k) removed[static_cast<std::size_t>(order[k])] = true;
  std::vector<int> reached = {order[0]};
  std::vector<bool> seen = removed;
  seen[static_cast<std::size_t>(order[0])] = true;
  for (std::size_t k = 0; k < reached.size(); ++k) {
    for (const int other : graph.of(reached[k])) {
      if (seen[static_cast<std::size_t>(other)]) continue;
      seen[static_cast<std::size_t>(other)] = true;
      reached.push_back(other);
    }
  }
  EXPECT_LT(reached.size(), 600U);
}

}  // namespace
}  // namespace ashlar::block_graph_test
