#include "solver/state/free_bodies.hpp"

#include "geometry/index.hpp"
#include "geometry/union_find.hpp"

namespace ashlar {

std::vector<std::vector<int>> free_bodies(const std::vector<BlockModel>& blocks,
                                          const std::vector<PairKey>& ties) {
  UnionFind tied(blocks.size());
  for (const auto& [a, b] : ties) tied.unite(a, b);
  std::vector<std::vector<int>> sets(blocks.size());
  std::vector<bool> free(blocks.size(), true);
  for (int k = 0; k < static_cast<int>(blocks.size()); ++k) {
    const BlockModel& block = blocks[at(k)];
    const int set = tied.find(k);
    sets[at(set)].push_back(k);
    if (block.fixed() || block.supported() || block.incremental() != nullptr) free[at(set)] = false;
  }
  std::vector<std::vector<int>> result;
  for (std::size_t set = 0; set < sets.size(); ++set)
    if (free[set] && !sets[set].empty()) result.push_back(std::move(sets[set]));
  return result;
}

}  // namespace ashlar
