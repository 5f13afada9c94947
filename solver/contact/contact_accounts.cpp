#include "solver/contact/contact_accounts.hpp"

#include <algorithm>
#include <set>

namespace ashlar {

double book(double work, double& account) {
  account += work;
  const double beyond = std::max(0.0, -account);
  account = std::max(0.0, account);
  return beyond;
}

IslandFunds::IslandFunds(const PairHistories& histories, std::vector<std::vector<PairKey>> islands,
                         const SharedAccounts* shared)
    : islands_(std::move(islands)), before_(islands_.size()) {
  std::set<PairKey> owned;
  for (std::size_t island = 0; island < islands_.size(); ++island) {
    for (const PairKey& pair : islands_[island]) {
      owned.insert(pair);
      before_[island].energy += history_of(histories, pair).spent;
    }
    before_[island].pairs = static_cast<double>(islands_[island].size());
  }
  for (const auto& [pair, history] : histories) {
    if (owned.count(pair) > 0 || (shared != nullptr && !shared->owns(pair))) continue;
    others_.push_back(pair);
    common_before_.energy += history.spent;
  }
  common_before_.pairs = static_cast<double>(others_.size());
  if (shared != nullptr) sum_over(*shared);
  for (const Sum& sum : before_) own_.push_back(sum.energy);
  common_ = common_before_.energy;
}

void IslandFunds::sum_over(const SharedAccounts& shared) {
  std::vector<double> sums = {common_before_.energy, common_before_.pairs};
  for (const Sum& sum : before_) sums.insert(sums.end(), {sum.energy, sum.pairs});
  sums = shared.sum(sums);
  common_before_ = {sums[0], sums[1]};
  for (std::size_t island = 0; island < before_.size(); ++island)
    before_[island] = {sums[2 * island + 2], sums[2 * island + 3]};
}

double IslandFunds::available(std::size_t island) const {
  return own_[island] + common_;
}

void IslandFunds::use(std::size_t island, double energy) {
  common_ = std::max(0.0, common_ - book(-energy, own_[island]));
}

void IslandFunds::spend_from(PairHistories& histories) const {
  const auto set_sum = [&](const std::vector<PairKey>& pairs, const Sum& before, double sum) {
    if (sum == before.energy) return;
    for (const PairKey& pair : pairs) {
      double& account = histories[pair].spent;
      account = before.energy > 0.0 ? account / before.energy * sum : sum / before.pairs;
    }
  };
  for (std::size_t island = 0; island < islands_.size(); ++island)
    set_sum(islands_[island], before_[island], own_[island]);
  set_sum(others_, common_before_, common_);
}

}  // namespace ashlar
