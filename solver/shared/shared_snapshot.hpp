// Snapshots of a run that several ranks share: the whole of it on the first rank, from which any number of ranks, or one
// process alone, goes on.
#pragma once

#include <functional>

#include "solver/shared/ghosts.hpp"
#include "solver/shared/pairs_of_run.hpp"
#include "solver/shared/run_totals.hpp"
#include "solver/step/accept/snapshot.hpp"

namespace ashlar {

/// Puts the snapshots of all ranks together, without factors; for pairs see pairs_of_run.hpp. Collective.
/// @param part snapshot_without_pairs() on this rank. @param totals of the run, on the first rank; null on others
/// @return on the first rank that of the run, on others `part`
[[nodiscard]] SimulationSnapshot whole_without_pairs(const BlockSystem& system, SimulationSnapshot part,
                                                     const RunTotals* totals);

/// Adds pairs of a run to a snapshot of it, as far as this rank may need them: histories and records of pairs with an own
/// block, initial overlaps of all. Collective. @param system of this rank, possibly with other owners than the run
/// @param pairs that all ranks visit
void add_pairs_of_rank(const BlockSystem& system, PairsOfRun& pairs, SimulationSnapshot& whole);

/// Hands over the histories that this rank needs of those of all pairs: whole ones of pairs of an own block and one that is here; of other
/// pairs that it makes the sums only, as if the other block had gone away. All ranks know initial overlaps. Collective.
/// @param whole of the run, the same on all ranks. @param keep called for each pair, with the history without what it has
/// found (forget_contacts) unless both blocks are here
void take_histories(const BlockSystem& system, const PairHistories& whole,
                    const std::function<void(const PairKey& blocks, PairHistory history)>& keep);

/// Restores the part of this rank, and finds its ghosts. Sums of the run so far are kept by the first rank. Collective.
/// @param whole of the run, the same on all ranks
/// @throws std::invalid_argument on all ranks if it was taken of other blocks
void restore_part(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches,
                  const SimulationSnapshot& whole);

/// Restores a snapshot of the start of the run that this rank took itself, whatever ghosts it had. Collective.
/// @param own snapshot_of() on this rank, before the first search for contacts
void restore_own(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches,
                 SimulationSnapshot own);

}  // namespace ashlar
