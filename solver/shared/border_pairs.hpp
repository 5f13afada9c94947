// Contact pairs of blocks of two ranks. One rank makes them, the owner of the lower block. The other one gets what they
// were made from, and makes the same pairs, to the bit: each computes all forces on its own block.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "solver/contact/contact_pair.hpp"
#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"

namespace ashlar {

/// Data that a contact pair is made from, besides its blocks.
struct PairRecipe {
  PairKey blocks = {-1, -1};
  JointLaw law;
  ContactPatch patch;
  std::vector<PointMemory> memory;  ///< (#points)
  PatchStart start;
};
[[nodiscard]] ContactPair make_pair(const BlockSystem& system, const RunState& state, PairRecipe recipe);

/// Recipe of a pair whose cached contacts are valid at the present state.
[[nodiscard]] PairRecipe kept_recipe(const RunState& state, const PairKey& blocks, const KeptContacts& kept,
                                     JointLaw law);

/// Remembers the cached contacts that both ranks of a pair have, so that they are sent once.
class BorderPairs {
 public:
  /// Sends recipes of own pairs to the owners of their other block, and receives theirs. Collective.
  /// @param recipes of pairs that this rank owns. @param law_of (blocks) -> law of a pair without rounding
  /// @return recipes from other ranks, by blocks
  [[nodiscard]] std::vector<PairRecipe> exchange(const BlockSystem& system, const RunState& state,
                                                 const std::vector<PairRecipe>& recipes,
                                                 const std::function<JointLaw(const PairKey&)>& law_of);
  /// To be called on all ranks when ghosts have changed or a state was restored.
  void forget() {
    sent_.clear();
    received_.clear();
  }

 private:
  std::map<PairKey, std::shared_ptr<const ContactCache>> sent_;
  std::map<PairKey, std::shared_ptr<const ContactCache>> received_;
};

/// Lets re-detected springs hold at most the energy of the last step. With several ranks collective.
/// @param pairs of contacts, made by this rank or received
void bound_energies(const BlockSystem& system, const RunState& state, std::vector<ContactPair>& pairs);

}  // namespace ashlar
