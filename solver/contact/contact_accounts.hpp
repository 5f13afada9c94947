// What contacts with multipliers have taken from blocks and not given back. Multipliers hold no energy, so
// that nothing but this bounds what they give: a pair gives back what it took, and blocks are moved apart
// (position_projection.cpp) for what the contacts of their island took, then for what all others did.
#pragma once

#include <vector>

#include "solver/contact/pair_history.hpp"

namespace ashlar {

/// Books work that the contact of a pair has taken from its blocks. @param work J; negative: given
/// @return what it has given beyond what was in its account, J, >= 0: the account is empty then
[[nodiscard]] double book(double work, double& account);

/// What islands may use of the accounts: each all of those of its own pairs, and of those that belong to no
/// island as much as the islands before have left. Nothing is used before spend_from().
class IslandFunds {
 public:
  /// @param islands pairs of each, none in two
  IslandFunds(const PairHistories& histories, std::vector<std::vector<PairKey>> islands);
  /// J, >= 0.
  [[nodiscard]] double available(std::size_t island) const;
  /// @param energy J, at most what is available; negative: comes to what the island has of its own
  void use(std::size_t island, double energy);
  /// Takes from the accounts what was used: of an island's pairs, and of those of no island, in proportion to
  /// what they have. What an island gained goes to its pairs in the same way, or to each as much if they have
  /// nothing.
  void spend_from(PairHistories& histories) const;

 private:
  std::vector<std::vector<PairKey>> islands_;
  std::vector<PairKey> others_;  ///< pairs that belong to no island
  std::vector<double> own_;      ///< left of each island's own, J
  double common_ = 0.0;          ///< left of what belongs to no island, J
};

}  // namespace ashlar
