#include "solver/contact/energy_bounds.hpp"

#include <algorithm>
#include <map>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// A pair with a deficit of energy, and the pairs with a common block that have lost energy.
struct Claim {
  double lacking = 0.0;         ///< J
  double received = 0.0;        ///< J
  std::vector<double*> losses;  ///< J, remaining; each once
};

/// Distributes losses in proportion to the deficits of claims, independent of the order of blocks. Each round
/// satisfies a claim or uses up all losses.
void share_out(std::vector<Claim>& claims) {
  bool satisfied = true;
  while (satisfied) {
    satisfied = false;
    std::map<double*, double> lacking;  // sum over all claims on a loss
    for (const Claim& claim : claims)
      for (double* loss : claim.losses) lacking[loss] += claim.lacking;
    std::map<double*, double> taken;
    for (Claim& claim : claims) {
      if (!(claim.lacking > 0.0)) continue;
      double offered = 0.0;
      for (double* loss : claim.losses) offered += *loss * (claim.lacking / lacking[loss]);
      if (!(offered > 0.0)) continue;
      const bool enough = offered >= claim.lacking;
      const double share = enough ? claim.lacking / offered : 1.0;
      for (double* loss : claim.losses) taken[loss] += share * *loss * (claim.lacking / lacking[loss]);
      claim.received += share * offered;
      claim.lacking = enough ? 0.0 : claim.lacking - offered;
      satisfied = satisfied || enough;
    }
    for (const auto& [loss, energy] : taken) *loss = std::max(0.0, *loss - energy);
  }
}

}  // namespace

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
    // Energy of bonds and multipliers is neither transferred nor bounded.
    double& rest = lost[blocks];
    rest = pair.can_be_bounded() ? std::max(0.0, rest - pair.start_energies().normal) : 0.0;
  }
  std::map<int, std::vector<PairKey>> lost_at;  // by moving block
  for (const auto& [blocks, rest] : lost) {
    if (!(rest > 0.0)) continue;
    for (const int block : blocks)
      if (moving[at(block)]) lost_at[block].push_back(blocks);
  }
  std::vector<Claim> claims(pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (!pairs[k].can_be_bounded()) continue;
    claims[k].lacking = std::max(0.0, pairs[k].start_energies().normal - bounds[k].normal);
    if (!(claims[k].lacking > 0.0)) continue;
    const PairKey blocks{pairs[k].a(), pairs[k].b()};
    for (const int block : blocks) {
      const auto known = lost_at.find(block);
      if (known == lost_at.end()) continue;
      for (const PairKey& other : known->second)
        if (other != blocks) claims[k].losses.push_back(&lost.at(other));
    }
  }
  share_out(claims);
  for (std::size_t k = 0; k < pairs.size(); ++k) bounds[k].normal += claims[k].received;
  return bounds;
}

}  // namespace ashlar
