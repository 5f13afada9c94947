// Accounts of the energy that blocks have spent on contacts with multipliers. Multipliers store no energy, so that
// only the account bounds the energy they may release. A pair releases at most its own account. Separation of blocks
// (position_projection.cpp) uses the accounts of the pairs of their island first, then those of pairs in no island.
#pragma once

#include <vector>

#include "solver/contact/pair_history.hpp"

namespace ashlar {

/// Adds work done by blocks on the contact of a pair to its account. @param work J; negative: released
/// @return energy released beyond the account, J, >= 0: the account is empty then
[[nodiscard]] double book(double work, double& account);

/// Energy that islands may use: each all accounts of its own pairs, then the accounts of pairs in no island as far as
/// earlier islands have left them. The accounts change in spend_from() only.
class IslandFunds {
 public:
  /// @param islands pairs of each, none in two
  IslandFunds(const PairHistories& histories, std::vector<std::vector<PairKey>> islands);
  /// Available energy, J, >= 0.
  [[nodiscard]] double available(std::size_t island) const;
  /// @param energy J, at most the available one; negative: added to the island's own
  void use(std::size_t island, double energy);
  /// Subtracts used energy from the accounts of an island's pairs and of pairs in no island, in proportion to their
  /// balances. Energy that an island gained is added to its pairs in the same way, or in equal parts if they have
  /// none.
  void spend_from(PairHistories& histories) const;

 private:
  std::vector<std::vector<PairKey>> islands_;
  std::vector<PairKey> others_;  ///< pairs in no island
  std::vector<double> own_;      ///< remaining energy of each island's own, J
  double common_ = 0.0;          ///< remaining energy of pairs in no island, J
};

}  // namespace ashlar
