#include "solver/contact_accounts.hpp"

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
  for (const auto& [pair, account] : accounts) common_ += owned.count(pair) > 0 ? 0.0 : account;
}

double IslandFunds::available(std::size_t island) const {
  return own_[island] + common_;
}

void IslandFunds::use(std::size_t island, double energy) {
  common_ = std::max(0.0, common_ - book(-energy, own_[island]));
}

void IslandFunds::spend_from(ContactAccounts& accounts) const {
  const auto sum_of = [&](const std::vector<std::array<int, 2>>& pairs) {
    double sum = 0.0;
    for (const std::array<int, 2>& pair : pairs) sum += accounts[pair];
    return sum;
  };
  const auto set_sum = [&](const std::vector<std::array<int, 2>>& pairs, double sum) {
    const double before = sum_of(pairs);
    for (const std::array<int, 2>& pair : pairs) {
      double& account = accounts[pair];
      account = before > 0.0 ? account / before * sum : sum / static_cast<double>(pairs.size());
    }
  };
  std::set<std::array<int, 2>> owned;
  for (std::size_t island = 0; island < islands_.size(); ++island) {
    set_sum(islands_[island], own_[island]);
    owned.insert(islands_[island].begin(), islands_[island].end());
  }
  std::vector<std::array<int, 2>> others;
  for (const auto& [pair, account] : accounts)
    if (owned.count(pair) == 0) others.push_back(pair);
  if (common_ != sum_of(others)) set_sum(others, common_);
}

}  // namespace ashlar
