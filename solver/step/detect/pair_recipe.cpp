#include "solver/step/detect/pair_recipe.hpp"

#include <algorithm>
#include <utility>

#include "geometry/index.hpp"
#include "solver/archived_geometry.hpp"
#include "solver/contact/energy_bounds.hpp"
#include "solver/state/agreement.hpp"

namespace ashlar {
namespace {

/// Transfers of all processes, in the order of blocks. Collective.
EnergyTransfers gathered(const BlockSystem& system, const EnergyTransfers& own) {
  EnergyTransfers all{joined_of_run(system, own.losses), joined_of_run(system, own.claims)};
  const auto by_blocks = [](const auto& x, const auto& y) { return x.blocks < y.blocks; };
  std::sort(all.losses.begin(), all.losses.end(), by_blocks);
  std::sort(all.claims.begin(), all.claims.end(), by_blocks);
  return all;
}

}  // namespace

ContactBody present_body(const BlockSystem& system, const RunState& state, int block) {
  return {&system.blocks()[at(block)], &state.states[at(block)], nullptr};
}

ContactPair make_pair(const BlockSystem& system, const RunState& state, PairRecipe recipe) {
  const auto [a, b] = recipe.blocks;
  return {PairBodies{a, b, present_body(system, state, a), present_body(system, state, b)}, recipe.law,
          std::move(recipe.patch), std::move(recipe.memory), recipe.start};
}

PairRecipe kept_recipe(const RunState& state, const PairKey& blocks, const KeptContacts& kept, JointLaw law) {
  const PairHistory& known = history_of(state.pairs, blocks);
  law.rounding = kept.cache->law.rounding;
  PatchStart start;
  start.continues = true;
  if (law.has_multipliers()) start.frozen = known.spent;
  return {blocks,
          law,
          {kept.points, kept.cache->found.cuts, kept.cache->found.turning, kept.cache->rows, kept.cache},
          known.memory.of_same(kept.points),
          start};
}

void bound_energies(const BlockSystem& system, const RunState& state, std::vector<ContactPair>& pairs) {
  const bool alone = system.exchange().alone();
  const bool all_go_on =
      std::all_of(pairs.begin(), pairs.end(), [](const ContactPair& pair) { return pair.continues(); });
  if (all_go_on && alone) return;
  const EnergyExchange exchange{
      [&system](const PairKey& blocks) { return system.owns_pair(blocks[0], blocks[1]); },
      [&system](const EnergyTransfers& own) { return gathered(system, own); }};
  const std::vector<SpringEnergy> bounds =
      energy_bounds(pairs, state.pairs, system.moving(), alone ? nullptr : &exchange);
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (!pairs[k].continues()) pairs[k].hold_at_most(bounds[k]);
}

}  // namespace ashlar
