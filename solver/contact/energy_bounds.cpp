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
    std::map<double*, double> removed;
    for (Claim& claim : claims) {
      if (!(claim.lacking > 0.0)) continue;
      double offered = 0.0;
      for (double* loss : claim.losses) offered += *loss * (claim.lacking / lacking[loss]);
      if (!(offered > 0.0)) continue;
      const bool enough = offered >= claim.lacking;
      const double share = enough ? claim.lacking / offered : 1.0;
      for (double* loss : claim.losses) removed[loss] += share * *loss * (claim.lacking / lacking[loss]);
      claim.received += share * offered;
      claim.lacking = enough ? 0.0 : claim.lacking - offered;
      satisfied = satisfied || enough;
    }
    for (const auto& [loss, energy] : removed) *loss = std::max(0.0, *loss - energy);
  }
}

/// Losses and claims of re-detected pairs. @param owns empty: of all
EnergyTransfers transfers_of(const std::vector<ContactPair>& pairs, const PairHistories& histories,
                             const std::vector<bool>& moving,
                             const std::function<bool(const PairKey&)>& owns) {
  const auto counts = [&owns](const PairKey& blocks) { return !owns || owns(blocks); };
  std::map<PairKey, double> lost;  // by normal springs
  for (const auto& [blocks, pair] : histories) {
    if (!moving[at(blocks[0])] && !moving[at(blocks[1])]) continue;
    if (pair.memory.held().normal > 0.0 && counts(blocks)) lost[blocks] = pair.memory.held().normal;
  }
  EnergyTransfers transfers;
  for (const ContactPair& pair : pairs) {
    const PairKey blocks{pair.a(), pair.b()};
    if (!counts(blocks)) continue;
    // Energy of bonds and multipliers is neither transferred nor bounded.
    double& rest = lost[blocks];
    rest = pair.can_be_bounded() ? std::max(0.0, rest - pair.start_energies().normal) : 0.0;
    if (!pair.can_be_bounded()) continue;
    const double lacking =
        std::max(0.0, pair.start_energies().normal - history_of(histories, blocks).memory.held().normal);
    if (lacking > 0.0) transfers.claims.push_back({blocks, lacking});
  }
  for (const auto& [blocks, rest] : lost)
    if (rest > 0.0)
      transfers.losses.push_back({blocks, rest, {moving[at(blocks[0])], moving[at(blocks[1])]}});
  return transfers;
}

/// Energy that each claim gets from losses at a common block, J.
std::map<PairKey, double> received_by(const EnergyTransfers& transfers) {
  std::map<PairKey, double> lost;
  std::map<int, std::vector<PairKey>> lost_at;  // by moving block
  for (const EnergyLoss& loss : transfers.losses) {
    lost[loss.blocks] = loss.energy;
    for (std::size_t side = 0; side < 2; ++side)
      if (loss.moves[side]) lost_at[loss.blocks[side]].push_back(loss.blocks);
  }
  std::vector<Claim> claims;
  for (const EnergyClaim& claim : transfers.claims) {
    claims.push_back({claim.lacking, 0.0, {}});
    for (const int block : claim.blocks) {
      const auto known = lost_at.find(block);
      if (known == lost_at.end()) continue;
      for (const PairKey& other : known->second)
        if (other != claim.blocks) claims.back().losses.push_back(&lost.at(other));
    }
  }
  share_out(claims);
  std::map<PairKey, double> received;
  for (std::size_t k = 0; k < claims.size(); ++k) received[transfers.claims[k].blocks] = claims[k].received;
  return received;
}

}  // namespace

std::vector<SpringEnergy> energy_bounds(const std::vector<ContactPair>& pairs, const PairHistories& histories,
                                        const std::vector<bool>& moving, const EnergyExchange* exchange) {
  EnergyTransfers transfers = transfers_of(
      pairs, histories, moving, exchange == nullptr ? std::function<bool(const PairKey&)>() : exchange->owns);
  if (exchange != nullptr) transfers = exchange->gather(transfers);
  const std::map<PairKey, double> received = received_by(transfers);
  std::vector<SpringEnergy> bounds;
  for (const ContactPair& pair : pairs) {
    const PairKey blocks{pair.a(), pair.b()};
    bounds.push_back(history_of(histories, blocks).memory.held());
    if (const auto found = received.find(blocks); found != received.end())
      bounds.back().normal += found->second;
  }
  return bounds;
}

}  // namespace ashlar
