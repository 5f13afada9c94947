// Blocks shared out again among ranks in a run, when they have moved so that some ranks have much more work than others.
//
// The weight of a rank is that of its blocks (weight_of_block): unknowns, and contact points of the last step. It depends on
// the state only, never on run time, so that a run takes the same decisions each time. Blocks whose owner changes are sent
// to the new one with their recent motion, and with the histories and records of their contacts; then each rank finds its
// ghosts. Energies booked so far stay where they are: only their sum over ranks has a meaning.
#pragma once

#include "solver/shared/ghosts.hpp"

namespace ashlar {

/// Weight of the own blocks of a rank after the last step; fixed and absent ones count 1.
[[nodiscard]] double weight_of_rank(const BlockSystem& system, const RunState& state);

/// Shares blocks out again if this step is one in which to look, the imbalance is beyond the limit, and the new partition
/// removes at least half of it; with tied blocks never. For the time between two steps. Collective.
/// @return true if owners have changed
bool balance_ranks(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches);

/// Gives blocks other owners between two steps. Collective; errors of the loader are thrown on all ranks.
/// @param owners rank of each block, the same on all ranks
void change_owners(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches,
                   std::vector<int> owners);

}  // namespace ashlar
