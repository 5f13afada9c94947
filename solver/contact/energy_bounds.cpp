#include "solver/contact/energy_bounds.hpp"

#include <algorithm>
#include <map>

#include "geometry/index.hpp"

namespace ashlar {

std::vector<SpringEnergy> energy_bounds(const std::vector<ContactPair>& pairs, const PairHistories& histories,
                                        const std::vector<bool>& moving) {
  std::map<PairKey, double> lost;  // by normal springs
  for (const auto& [blocks, pair] : histories) {
    if (!moving[at(blocks[0])] && !moving[at(blocks[1])]) continue;
    if (pair.memory.held().normal > 0.0) lost[blocks] = pair.memory.held().normal;
  }
  std::vector<SpringEnergy> bounds;
  for (const ContactPair& pair : pairs) {
    const PairKey blocks{pair.a(), pair.b()};
    bounds.push_back(history_of(histories, blocks).memory.held());
    // What bonds and multipliers hold is not given away: nothing bounds them either.
    double& rest = lost[blocks];
    rest = pair.can_be_bounded() ? std::max(0.0, rest - pair.start_energies().normal) : 0.0;
  }
  std::map<int, std::vector<PairKey>> lost_at;  // by moving block
  for (const auto& [blocks, rest] : lost) {
    if (!(rest > 0.0)) continue;
    for (const int block : blocks)
      if (moving[at(block)]) lost_at[block].push_back(blocks);
  }
  const auto sharing = [&](const PairKey& blocks) {
    std::vector<PairKey> others;
    for (const int block : blocks) {
      if (const auto known = lost_at.find(block); known != lost_at.end())
        others.insert(others.end(), known->second.begin(), known->second.end());
    }
    std::sort(others.begin(), others.end());
    return others;
  };
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const PairKey blocks{pairs[k].a(), pairs[k].b()};
    if (!pairs[k].can_be_bounded()) continue;
    double lacking = pairs[k].start_energies().normal - bounds[k].normal;
    if (!(lacking > 0.0)) continue;
    for (const PairKey& other : sharing(blocks)) {
      double& rest = lost.at(other);
      if (!(lacking > 0.0)) break;
      if (!(rest > 0.0) || other == blocks) continue;
      const double taken = std::min(rest, lacking);
      bounds[k].normal += taken;
      rest -= taken;
      lacking -= taken;
    }
  }
  return bounds;
}

}  // namespace ashlar
