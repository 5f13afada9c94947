#include "solver/bolts/bolted_blocks.hpp"

#include <algorithm>

namespace ashlar {

std::vector<int> present_blocks(const BoltChain& chain) {
  std::vector<int> blocks;
  for (std::size_t k = 0; k < chain.shape().pieces().size(); ++k)
    if (chain.present(k)) blocks.push_back(chain.shape().pieces()[k].block);
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  return blocks;
}

}  // namespace ashlar
