#include "solver/contact/energy_bounds.hpp"

#include <algorithm>
#include <map>

namespace ashlar {

std::vector<SpringEnergy> energy_bounds(const std::vector<ContactPair>& pairs, const PairHistories& histories,
                                        const std::vector<bool>& moving) {
  std::map<PairKey, double> lost;  // by normal springs
  for (const auto& [blocks, pair] : histories) {
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
  const auto shared = [&](const PairKey& x, const PairKey& y) {
    return std::any_of(x.begin(), x.end(), [&](int block) {
      return moving[static_cast<std::size_t>(block)] && (block == y[0] || block == y[1]);
    });
  };
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const PairKey blocks{pairs[k].a(), pairs[k].b()};
    if (!pairs[k].can_be_bounded()) continue;
    double lacking = pairs[k].start_energies().normal - bounds[k].normal;
    for (auto& [other, rest] : lost) {
      if (!(lacking > 0.0)) break;
      if (!(rest > 0.0) || other == blocks || !shared(other, blocks)) continue;
      const double taken = std::min(rest, lacking);
      bounds[k].normal += taken;
      rest -= taken;
      lacking -= taken;
    }
  }
  return bounds;
}

}  // namespace ashlar
