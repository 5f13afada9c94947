// Disjoint sets of numbers with union operations.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace ashlar {

/// At first every number from 0 to size - 1 is a set of its own.
class UnionFind {
 public:
  explicit UnionFind(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
  /// The root of a number's set, which is the same for all its members.
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The smaller root wins, so a root is the first member of its set.
  void unite(int i, int j) {
    const auto [low, high] = std::minmax({find(i), find(j)});
    parent_[high] = low;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace ashlar
