// Contact pairs of blocks of two ranks. One rank makes them, the owner of the lower block. The other one gets what they
// were made from, and makes the same pairs, to the bit: each computes all forces on its own block.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "solver/step/detect/pair_recipe.hpp"

namespace ashlar {

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

}  // namespace ashlar
