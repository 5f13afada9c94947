#include "solver/shared/shared_snapshot.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

#include "geometry/index.hpp"
#include "solver/archived_geometry.hpp"
#include "solver/shared/shared_bolts.hpp"
#include "solver/shared/shared_step.hpp"
#include "solver/step/island/bolts_of_run.hpp"

namespace ashlar {
namespace {

/// Values by block, at a place each: all blocks of the run, or those of a rank alone.
struct BlockOf {
  int place;
  int places;
};

/// Copies the value of a block if there is one.
template <class Value>
void take_value(const std::vector<Value>& from, int place, std::vector<Value>& to, const BlockOf& block) {
  if (at(place) >= from.size()) return;
  if (to.size() <= at(block.place)) to.resize(at(block.places));
  to[at(block.place)] = from[at(place)];
}

void take_block(const SimulationSnapshot& from, int place, SimulationSnapshot& to, const BlockOf& block) {
  const auto take = [&](const auto& values, auto& target) { take_value(values, place, target, block); };
  take(from.run.states, to.run.states);
  take(from.run.accelerations, to.run.accelerations);
  take(from.run.spin_debts, to.run.spin_debts);
  take(from.run.sleep.rests, to.run.sleep.rests);
  take(from.finder.tracks, to.finder.tracks);
  take(from.finder.divisions, to.finder.divisions);
  const StaticState& statics = from.run.statics;
  StaticState& target = to.run.statics;
  take(statics.level_start, target.level_start);
  take(statics.progress.positions, target.progress.positions);
  take(statics.progress.forces, target.progress.forces);
  take(statics.progress.displacements, target.progress.displacements);
  take(statics.progress.residuals, target.progress.residuals);
  take(statics.onset.unbalanced, target.onset.unbalanced);
  take(statics.onset.is_compliant, target.onset.is_compliant);
  take(statics.onset.starts, target.onset.starts);
}

/// Fixed blocks of the run, by block. Collective.
std::vector<bool> fixed_blocks(const BlockSystem& system) {
  std::vector<int> own;
  for (const int k : share_of(system).own())
    if (system.blocks()[at(k)].fixed()) own.push_back(k);
  std::vector<bool> fixed(at(system.count()), false);
  for (const std::vector<int>& of_rank : values_of_ranks(share_of(system).ranks(), own))
    for (const int k : of_rank) fixed[at(k)] = true;
  return fixed;
}

/// Removes bolts and sliding pairs that other ranks tell.
void keep_own(const BlockSystem& system, RunState& run) {
  std::erase_if(run.statics.onset.sliding,
                [&](const PairKey& pair) { return !system.owns_pair(pair[0], pair[1]); });
  for (std::size_t k = 0; k < run.bolts.size(); ++k)
    if (!owns_bolt(system, k)) run.bolts[k] = {};
}

/// Removes changes of the models of other blocks.
template <class Keeps>
void keep_changes(SimulationSnapshot& snapshot, const Keeps& keeps) {
  const auto is_other = [&](const auto& entry) { return !keeps(entry.first); };
  std::erase_if(snapshot.reactions, is_other);
  std::erase_if(snapshot.carried, is_other);
}

/// Values of the own blocks of this rank, in their order, without pairs: other ranks do not know them.
SimulationSnapshot values_of_own(const BlockShare& share, const SimulationSnapshot& part) {
  SimulationSnapshot own;
  const auto count = static_cast<int>(share.own().size());
  for (int k = 0; k < count; ++k) take_block(part, share.own()[at(k)], own, {k, count});
  for (const SleepingIsland& island : part.run.sleep.islands)
    own.run.sleep.islands.push_back({{}, island.held});
  own.run.statics.onset.sliding = part.run.statics.onset.sliding;
  own.run.bolts = part.run.bolts;
  own.reactions = part.reactions;
  own.carried = part.carried;
  return own;
}

void merge_values(const BlockShare& share, int rank, SimulationSnapshot of_rank, SimulationSnapshot& whole) {
  for (int block = 0, k = 0; block < share.count(); ++block)
    if (share.owner(block) == rank) take_block(of_rank, k++, whole, {block, share.count()});
  // All ranks list the same islands, each with the energy that it holds.
  for (std::size_t k = 0; k < whole.run.sleep.islands.size(); ++k)
    whole.run.sleep.islands[k].held += of_rank.run.sleep.islands.at(k).held;
  for (std::size_t k = 0; k < whole.run.bolts.size(); ++k)
    if (of_rank.run.bolts[k].installed()) whole.run.bolts[k] = of_rank.run.bolts[k];
  whole.reactions.merge(of_rank.reactions);
  whole.carried.merge(of_rank.carried);
  std::vector<PairKey>& sliding = whole.run.statics.onset.sliding;
  const std::vector<PairKey>& others = of_rank.run.statics.onset.sliding;
  sliding.insert(sliding.end(), others.begin(), others.end());
}

/// Tracks and divisions of the blocks that a rank has.
FinderState finder_state_here(const BlockSystem& system, const ContactFinder& finder,
                              const SimulationSnapshot& whole, bool first) {
  FinderState here = finder.state();
  for (int k = 0; k < system.count(); ++k) {
    if (!system.here(k)) continue;
    take_value(whole.finder.tracks, k, here.tracks, {k, system.count()});
    take_value(whole.finder.divisions, k, here.divisions, {k, system.count()});
  }
  here.counts = first ? whole.finder.counts : FinderCounts{};
  return here;
}

/// The part of a whole snapshot without pairs, for the blocks that are here.
SimulationSnapshot part_without_pairs(const BlockSystem& system, const RunState& state,
                                      const StepCaches& caches, const SimulationSnapshot& whole, bool first) {
  const SimulationSnapshot present = snapshot_without_pairs(system, state, caches);
  SimulationSnapshot part = without_pairs(whole);
  for (int k = 0; k < system.count(); ++k)
    if (!system.here(k)) take_block(present, k, part, {k, system.count()});
  part.finder = finder_state_here(system, caches.contacts.finder(), whole, first);
  keep_changes(part, [&](int block) {
    return system.here(block) || system.blocks()[at(block)].incremental() != nullptr;
  });
  part.factors.clear();
  // Depths are measured anew.
  part.run.depths = state.depths;
  if (first) return part;
  for (SleepingIsland& island : part.run.sleep.islands) island.held = 0.0;
  part.run.ledger.set({}, 0.0);
  part.run.report = {};
  part.run.report.step = whole.run.report.step;
  part.run.extremes = {};
  part.run.log.counts = {};
  return part;
}

}  // namespace

SimulationSnapshot whole_without_pairs(const BlockSystem& system, SimulationSnapshot part,
                                       const RunTotals* totals) {
  const BlockShare& share = share_of(system);
  keep_own(system, part.run);
  keep_changes(part, [&](int block) { return system.owns(block); });
  part.factors.clear();
  const double balance = sum_of_ranks(share.ranks(), part.run.ledger.start_balance());
  send_to_first(
      share.ranks(), [&](ByteWriter& writer) { writer(values_of_own(share, part)); },
      [&](ByteReader& reader, int rank) {
        SimulationSnapshot other;
        reader(other);
        merge_values(share, rank, std::move(other), part);
      });
  if (share.ranks().own() > 0) return part;
  if (totals == nullptr) throw std::logic_error("results are gathered before a snapshot of several ranks");
  std::sort(part.run.statics.onset.sliding.begin(), part.run.statics.onset.sliding.end());
  part.run.ledger.set(totals->ledger, balance);
  part.run.report = totals->report;
  part.run.extremes = totals->extremes;
  part.run.log.counts = totals->counts;
  part.finder.counts = totals->counts.finder;
  part.run.depths = {};
  return part;
}

void add_pairs_of_rank(const BlockSystem& system, PairsOfRun& pairs, SimulationSnapshot& whole) {
  const auto is_own = [&system](int a, int b) { return system.owns(a) || system.owns(b); };
  pairs.visit_histories([](std::size_t) {},
                        [&](const PairKey& blocks, const PairHistory& history) {
                          if (is_own(blocks[0], blocks[1]))
                            whole.run.pairs.insert_or_assign(blocks, history);
                          else if (history.overlap > 0.0)
                            whole.run.pairs[blocks].overlap = history.overlap;
                        });
  pairs.visit_records([](std::size_t) {},
                      [&](const PairRecord& record) {
                        if (is_own(record.a, record.b)) whole.run.records.push_back(record);
                      });
}

void take_histories(const BlockSystem& system, const PairHistories& whole,
                    const std::function<void(const PairKey& blocks, PairHistory history)>& keep) {
  const std::vector<bool> fixed = fixed_blocks(system);
  for (const auto& [blocks, history] : whole) {
    const auto [a, b] = blocks;
    const bool concerned = system.owns(a) || system.owns(b);
    if (concerned && system.here(a) && system.here(b)) {
      keep(blocks, history);
    } else if (concerned && system.owns(fixed[at(a)] ? b : a)) {
      PairHistory sums = history;
      forget_contacts(sums);
      keep(blocks, std::move(sums));
    } else if (history.overlap > 0.0) {
      PairHistory known;
      known.overlap = history.overlap;
      keep(blocks, std::move(known));
    }
  }
}

void restore_part(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches,
                  const SimulationSnapshot& whole) {
  if (whole.run.states.size() != at(system.count()) || !whole.load_factors.empty())
    throw std::invalid_argument("the snapshot has other blocks");
  const bool first = shared.share->ranks().own() == 0;
  do_on_all(shared.share->ranks(),
            [&] { restore(system, state, caches, part_without_pairs(system, state, caches, whole, first)); });
  find_ghosts(shared, system, state, caches);
  ContactFinder& finder = caches.contacts.finder();
  finder.restore(finder_state_here(system, finder, whole, first));
  std::vector<std::pair<PairKey, PairHistory>> here;
  take_histories(system, whole.run.pairs, [&here](const PairKey& blocks, PairHistory history) {
    here.emplace_back(blocks, std::move(history));
  });
  do_on_all(shared.share->ranks(), [&] {
    const std::vector<BlockSurface>& surfaces = finder.surfaces();
    for (auto& [blocks, history] : here) {
      const auto [a, b] = blocks;
      PairHistory& pair = state.pairs[blocks] = std::move(history);
      if (pair.cache != nullptr)
        pair.cache = with_rows(*pair.cache, system.blocks()[at(a)], system.blocks()[at(b)], surfaces[at(a)],
                               surfaces[at(b)]);
    }
  });
  update_ghost_contacts(system, state);
  for (const PairRecord& record : whole.run.records)
    if (system.here(record.a) && system.here(record.b)) state.records.push_back(record);
  std::erase_if(state.statics.onset.sliding,
                [&](const PairKey& pair) { return !system.concerns(pair[0], pair[1]); });
}

void restore_own(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches,
                 SimulationSnapshot own) {
  const SimulationSnapshot present = snapshot_of(system, state, caches);
  for (int k = 0; k < system.count(); ++k)
    if (!system.owns(k)) take_block(present, k, own, {k, system.count()});
  std::erase_if(own.run.pairs, [&](const auto& entry) {
    return !system.here(entry.first[0]) || !system.here(entry.first[1]);
  });
  restore(system, state, caches, own);
  find_ghosts(shared, system, state, caches);
}

}  // namespace ashlar
