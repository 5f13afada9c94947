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

IslandFunds::IslandFunds(const PairHistories& histories, std::vector<std::vector<PairKey>> islands)
    : islands_(std::move(islands)), own_(islands_.size(), 0.0) {
  std::set<PairKey> owned;
  for (std::size_t island = 0; island < islands_.size(); ++island) {
    for (const PairKey& pair : islands_[island]) {
      owned.insert(pair);
      own_[island] += history_of(histories, pair).taken;
    }
  }
  for (const auto& [pair, history] : histories) {
    if (owned.count(pair) > 0) continue;
    others_.push_back(pair);
    common_ += history.taken;
  }
}

double IslandFunds::available(std::size_t island) const {
  return own_[island] + common_;
}

void IslandFunds::use(std::size_t island, double energy) {
  common_ = std::max(0.0, common_ - book(-energy, own_[island]));
}

void IslandFunds::spend_from(PairHistories& histories) const {
  const auto set_sum = [&](const std::vector<PairKey>& pairs, double sum) {
    double before = 0.0;
    for (const PairKey& pair : pairs) before += histories[pair].taken;
    if (sum == before) return;
    for (const PairKey& pair : pairs) {
      double& account = histories[pair].taken;
      account = before > 0.0 ? account / before * sum : sum / static_cast<double>(pairs.size());
    }
  };
  for (std::size_t island = 0; island < islands_.size(); ++island) set_sum(islands_[island], own_[island]);
  set_sum(others_, common_);
}

}  // namespace ashlar
