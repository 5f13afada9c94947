#include "solver/linear/front_tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "support/random_blocks.hpp"

namespace ashlar::front_tree_test {
namespace {

struct Grid {
  std::vector<int> sizes;
  BlockMatrix blocks;
  FrontTree tree;
  Grid(const std::array<int, 3>& counts, int size)
      : sizes(static_cast<std::size_t>(counts[0] * counts[1] * counts[2]), size),
        blocks(sizes, pairs_of_grid(counts)),
        tree(make_front_tree(blocks.matrix(), sizes)) {}
};

/// Pairs of places between which elimination in order leaves an entry, by elimination of the graph itself.
std::set<std::pair<int, int>> fill_of(const std::vector<std::array<int, 2>>& pairs,
                                      const std::vector<int>& order) {
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  std::vector<std::set<int>> later(order.size());
  for (const auto& [a, b] : pairs) {
    const auto [low, high] =
        std::minmax({place[static_cast<std::size_t>(a)], place[static_cast<std::size_t>(b)]});
    later[static_cast<std::size_t>(low)].insert(high);
  }
  std::set<std::pair<int, int>> fill;
  for (std::size_t k = 0; k < later.size(); ++k) {
    for (const int a : later[k]) {
      fill.emplace(static_cast<int>(k), a);
      for (const int b : later[k])
        if (b > a) later[static_cast<std::size_t>(a)].insert(b);
    }
  }
  return fill;
}

TEST(FrontTree, HoldsAllEntriesOfTheFactorAndFewZeros) {
  const std::array<int, 3> counts = {12, 10, 1};
  const Grid grid(counts, 3);
  const FrontTree& tree = grid.tree;
  std::vector<int> sorted = tree.order;
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> all(120);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(sorted, all);
  std::set<std::pair<int, int>> held;
  int next = 0;
  for (const Front& front : tree.fronts) {
    EXPECT_EQ(front.first_block, next);  // each block is a pivot once
    next = front.last_block + 1;
    EXPECT_TRUE(std::is_sorted(front.blocks_below.begin(), front.blocks_below.end()));
    for (int j = front.first_block; j <= front.last_block; ++j) {
      for (int k = j + 1; k <= front.last_block; ++k) held.emplace(j, k);
      for (const int k : front.blocks_below) held.emplace(j, k);
    }
  }
  EXPECT_EQ(next, 120);
  const std::set<std::pair<int, int>> fill = fill_of(pairs_of_grid(counts), tree.order);
  EXPECT_TRUE(std::includes(held.begin(), held.end(), fill.begin(), fill.end()));
  // Small fronts may hold up to 40 % zeros, so few that all together remain below a fifth.
  EXPECT_LT(static_cast<double>(held.size()), 1.2 * static_cast<double>(fill.size()));
  // Nested dissection of a grid of n blocks leaves O(n log n) entries; in the order of rows they are 10 n.
  EXPECT_LT(fill.size(), 1200U);
}

TEST(FrontTree, CountsEntriesAndMultiplications) {
  // One front: the columns of a triangle of 6 have 6 + 5 + ... + 1 entries, their squares are the multiplications.
  const FrontTree one = make_front_tree(BlockMatrix({6}, {}).matrix(), {6});
  EXPECT_EQ(one.entries, 21U);
  EXPECT_EQ(one.work, 91.0);
  EXPECT_EQ(one.largest_front, 6);
  // Two blocks that touch merge into one front.
  EXPECT_EQ(make_front_tree(BlockMatrix({3, 3}, {{0, 1}}).matrix(), {3, 3}).fronts.size(), 1U);
  EXPECT_EQ(make_front_tree(BlockMatrix({3, 3}, {}).matrix(), {3, 3}).fronts.size(), 2U);
}

TEST(FrontTree, EachUnknownBelowHasItsPlaceInTheParent) {
  const Grid grid({6, 6, 6}, 2);
  const FrontTree& tree = grid.tree;
  /// Place in the vector of all unknowns of each unknown of a front.
  const auto unknowns_of = [&](const Front& front) {
    std::vector<int> unknowns(static_cast<std::size_t>(front.pivots));
    std::iota(unknowns.begin(), unknowns.end(), front.start);
    for (const int block : front.blocks_below)
      for (int k = tree.start[static_cast<std::size_t>(block)];
           k < tree.start[static_cast<std::size_t>(block) + 1]; ++k)
        unknowns.push_back(k);
    return unknowns;
  };
  for (const Front& front : tree.fronts) {
    const std::vector<int> own = unknowns_of(front);
    ASSERT_EQ(static_cast<int>(own.size()), front.size());
    int covered = 0;
    for (const RowRun& run : front.in_vector) {
      EXPECT_EQ(run.from, covered);
      for (int k = 0; k < run.length; ++k, ++covered)
        EXPECT_EQ(own[static_cast<std::size_t>(front.pivots + run.from + k)], run.to + k);
    }
    EXPECT_EQ(covered, front.below);
    if (front.parent < 0) continue;
    const std::vector<int> parents = unknowns_of(tree.fronts[static_cast<std::size_t>(front.parent)]);
    covered = 0;
    for (const RowRun& run : front.in_parent)
      for (int k = 0; k < run.length; ++k, ++covered)
        EXPECT_EQ(own[static_cast<std::size_t>(front.pivots + run.from + k)],
                  parents[static_cast<std::size_t>(run.to + k)]);
    EXPECT_EQ(covered, front.below);
  }
}

/// Memory of an update, and when it is needed.
struct Stored {
  std::size_t first, end;
  int from, to;  ///< fronts
};

TEST(FrontTree, UpdatesThatAreNeededDoNotOverlap) {
  const Grid grid({8, 8, 4}, 3);
  const FrontTree& tree = grid.tree;
  int last = -1;
  std::vector<Stored> kept;
  for (const TreePart& part : tree.parts) {
    EXPECT_EQ(part.first, last + 1);
    last = part.last;
    std::vector<Stored> stacks[2];
    for (int k = part.first; k <= part.last; ++k) {
      const Front& front = tree.fronts[static_cast<std::size_t>(k)];
      if (front.below == 0) continue;
      const std::size_t values =
          static_cast<std::size_t>(front.below) * static_cast<std::size_t>(front.below);
      EXPECT_EQ(front.kept, front.parent > part.last);
      // Kept updates of parts that run at the same time are all needed at once.
      (front.kept ? kept : stacks[front.stack])
          .push_back(
              {front.update, front.update + values, front.kept ? 0 : k, front.kept ? 0 : front.parent});
    }
    for (int stack = 0; stack < 2; ++stack)
      for (const Stored& a : stacks[stack]) {
        EXPECT_LE(a.end, tree.stack_values[stack]);
        for (const Stored& b : stacks[stack])
          if (a.from < b.from && b.from <= a.to) {
            EXPECT_TRUE(a.end <= b.first || b.end <= a.first);
          }
      }
  }
  EXPECT_EQ(last + 1, static_cast<int>(tree.fronts.size()));
  for (const Stored& a : kept) {
    EXPECT_LE(a.end, tree.kept_values);
    for (const Stored& b : kept)
      if (&a != &b) {
        EXPECT_TRUE(a.end <= b.first || b.end <= a.first);
      }
  }
}

TEST(FrontTree, PartsHaveTheirShareOfTheWork) {
  const Grid grid({30, 30, 1}, 6);
  const FrontTree& tree = grid.tree;
  int small = 0;
  for (const TreePart& part : tree.parts) {
    double work = 0.0;
    for (int k = part.first; k <= part.last; ++k) work += tree.fronts[static_cast<std::size_t>(k)].work;
    if (part.first < part.last) {
      // Up to half a share of subtrees, and one more of a share at most.
      EXPECT_LE(work, 1.5 * tree.work / 64.0);
      ++small;
    }
  }
  EXPECT_GE(small, 16);  // enough for several threads
}

}  // namespace
}  // namespace ashlar::front_tree_test
