// Accounts of the energy that blocks have spent on contacts with multipliers. Multipliers store no energy, so that
// only the account bounds the energy they may release. A pair releases at most its own account. Separation of blocks
// (position_projection.cpp) uses the accounts of the pairs of their island first, then those of pairs in no island.
#pragma once

#include <functional>
#include <vector>

#include "solver/contact/pair_history.hpp"

namespace ashlar {

/// Adds work done by blocks on the contact of a pair to its account. @param work J; negative: released
/// @return energy released beyond the account, J, >= 0: the account is empty then
[[nodiscard]] double book(double work, double& account);

/// The accounts of a run that processes share.
struct SharedAccounts {
  std::function<bool(const PairKey&)> owns;  ///< pairs whose accounts this process keeps
  std::function<std::vector<double>(const std::vector<double>& values)> sum;  ///< over processes
};

/// Energy that islands may use: each all accounts of its own pairs, then the accounts of pairs in no island as far as
/// earlier islands have left them. The accounts change in spend_from() only.
class IslandFunds {
 public:
  /// @param islands pairs of each, none in two
  /// @param shared null: one process has all accounts. Otherwise collective: islands are the same on all processes, each with the
  /// pairs that this process owns, and all processes use the same energies
  IslandFunds(const PairHistories& histories, std::vector<std::vector<PairKey>> islands,
              const SharedAccounts* shared = nullptr);
  /// Available energy, J, >= 0.
  [[nodiscard]] double available(std::size_t island) const;
  /// @param energy J, at most the available one; negative: added to the island's own
  void use(std::size_t island, double energy);
  /// Subtracts used energy from the accounts of an island's pairs and of pairs in no island, in proportion to their
  /// balances. Energy that an island gained is added to its pairs in the same way, or in equal parts if they have
  /// none.
  void spend_from(PairHistories& histories) const;

 private:
  /// Accounts of all processes before anything is used.
  struct Sum {
    double energy = 0.0;  ///< J
    double pairs = 0.0;   ///< their number
  };
  void sum_over(const SharedAccounts& shared);

  std::vector<std::vector<PairKey>> islands_;
  std::vector<PairKey> others_;  ///< pairs in no island
  std::vector<Sum> before_;      ///< of each island
  Sum common_before_;            ///< of pairs in no island
  std::vector<double> own_;      ///< remaining energy of each island's own, J
  double common_ = 0.0;          ///< remaining energy of pairs in no island, J
};

}  // namespace ashlar
