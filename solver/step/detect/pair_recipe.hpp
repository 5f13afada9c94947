// Data from which the contact pair of two blocks is made.
#pragma once

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
/// A block as a contact pair takes it: its model and present state.
[[nodiscard]] ContactBody present_body(const BlockSystem& system, const RunState& state, int block);
[[nodiscard]] ContactPair make_pair(const BlockSystem& system, const RunState& state, PairRecipe recipe);

/// Recipe of a pair whose cached contacts are valid at the present state.
[[nodiscard]] PairRecipe kept_recipe(const RunState& state, const PairKey& blocks, const KeptContacts& kept,
                                     JointLaw law);

/// Lets re-detected springs hold at most the energy of the last step. With other processes collective.
/// @param pairs of contacts, made by this process or received
void bound_energies(const BlockSystem& system, const RunState& state, std::vector<ContactPair>& pairs);

}  // namespace ashlar
