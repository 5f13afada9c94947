// Pairs of blocks, by their numbers.
#pragma once

#include <algorithm>
#include <array>

namespace ashlar {

/// Two blocks in an order whose meaning the place of use states.
using BlockPair = std::array<int, 2>;

/// Two blocks, the lower number first.
using PairKey = std::array<int, 2>;

/// The key of two blocks in any order.
[[nodiscard]] inline PairKey key_of(const BlockPair& blocks) {
  return {std::min(blocks[0], blocks[1]), std::max(blocks[0], blocks[1])};
}

}  // namespace ashlar
