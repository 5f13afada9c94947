#include "solver/state/free_bodies.hpp"

#include "geometry/index.hpp"
#include "geometry/union_find.hpp"

namespace ashlar {

bool may_turn_freely(const BlockModel& block) {
  return !block.fixed() && !block.supported() && block.incremental() == nullptr;
}

std::vector<std::vector<int>> free_bodies(const std::vector<BlockModel>& blocks,
                                          const std::vector<PairKey>& ties) {
  std::vector<bool> free;
  free.reserve(blocks.size());
  for (const BlockModel& block : blocks) free.push_back(may_turn_freely(block));
  return free_bodies(free, ties);
}

std::vector<std::vector<int>> free_bodies(const std::vector<bool>& free, const std::vector<PairKey>& ties) {
  UnionFind tied(free.size());
  for (const auto& [a, b] : ties) tied.unite(a, b);
  std::vector<std::vector<int>> sets(free.size());
  std::vector<bool> all_free(free.size(), true);
  for (int k = 0; k < static_cast<int>(free.size()); ++k) {
    const int set = tied.find(k);
    sets[at(set)].push_back(k);
    if (!free[at(k)]) all_free[at(set)] = false;
  }
  std::vector<std::vector<int>> result;
  for (std::size_t set = 0; set < sets.size(); ++set)
    if (all_free[set] && !sets[set].empty()) result.push_back(std::move(sets[set]));
  return result;
}

}  // namespace ashlar
