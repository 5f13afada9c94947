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

IslandFunds::IslandFunds(const ContactAccounts& accounts,
                         std::vector<std::vector<std::array<int, 2>>> islands)
    : islands_(std::move(islands)), own_(islands_.size(), 0.0) {
  std::set<std::array<int, 2>> owned;
  for (std::size_t island = 0; island < islands_.size(); ++island) {
    for (const std::array<int, 2>& pair : islands_[island]) {
      owned.insert(pair);
      if (const auto account = accounts.find(pair); account != accounts.end())
        own_[island] += account->second;
    }
  }
  for (const auto& [pair, account] : accounts) {
    if (owned.count(pair) > 0) continue;
    others_.push_back(pair);
    common_ += account;
  }
}

double IslandFunds::available(std::size_t island) const {
  return own_[island] + common_;
}

void IslandFunds::use(std::size_t island, double energy) {
  common_ = std::max(0.0, common_ - book(-energy, own_[island]));
}

void IslandFunds::spend_from(ContactAccounts& accounts) const {
  const auto set_sum = [&](const std::vector<std::array<int, 2>>& pairs, double sum) {
    double before = 0.0;
    for (const std::array<int, 2>& pair : pairs) before += accounts[pair];
    if (sum == before) return;
    for (const std::array<int, 2>& pair : pairs) {
      double& account = accounts[pair];
      account = before > 0.0 ? account / before * sum : sum / static_cast<double>(pairs.size());
    }
  };
  for (std::size_t island = 0; island < islands_.size(); ++island) set_sum(islands_[island], own_[island]);
  set_sum(others_, common_);
}

}  // namespace ashlar
