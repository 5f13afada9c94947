#include "solver/shared/rank_balance.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "geometry/index.hpp"
#include "solver/archived_geometry.hpp"
#include "solver/bolts/bolted_blocks.hpp"
#include "solver/shared/ghost_models.hpp"
#include "solver/shared/shared_bolts.hpp"
#include "solver/shared/shared_step.hpp"
#include "solver/step/island/bolts_of_run.hpp"

namespace ashlar {
namespace {

/// All that the owner of a block knows of it beyond its model and contacts.
struct MovedBlock {
  int block = -1;
  BlockState state;
  Eigen::MatrixX3d acceleration;  ///< empty: the integrator uses none
  double spin_debt = 0.0;
  BlockRest rest;
  BlockTrack track;
  SurfaceDivision division;
  ModelChange change;
};

/// Message of a rank to a new owner.
struct MovedPart {
  std::vector<MovedBlock> blocks;
  PairHistories pairs;
  std::vector<PairRecord> records;

  [[nodiscard]] bool empty() const { return blocks.empty() && pairs.empty() && records.empty(); }
};

/// Own blocks with their contacts in the last step.
std::vector<PartitionBlock> blocks_of_rank(const BlockSystem& system, const RunState& state) {
  const BlockShare& share = share_of(system);
  std::map<int, std::map<int, int>> points;  // of moving blocks
  const auto moves = [&](int block) { return system.here(block) && !system.blocks()[at(block)].fixed(); };
  std::map<int, int> all;
  for (const PairRecord& record : state.records) {
    const int count = std::max(1, static_cast<int>(record.points.size()));
    for (const auto& [one, other] : {std::pair(record.a, record.b), std::pair(record.b, record.a)}) {
      if (!share.owns(one) || !moves(one)) continue;
      all[one] += count;
      if (moves(other)) points[one][other] = count;
    }
  }
  for (std::size_t n = 0; n < system.bolts().size(); ++n) {
    if (!state.bolts[n].installed()) continue;
    const std::vector<int> bolted = present_blocks(system.bolts()[n].chain);
    for (const int one : bolted)
      for (const int other : bolted)
        if (one != other && share.owns(one) && moves(one) && moves(other)) ++points[one][other];
  }
  std::vector<PartitionBlock> own;
  for (const int k : share.own()) {
    const BlockModel& model = system.blocks()[at(k)];
    PartitionBlock& block = own.emplace_back();
    block.block = k;
    block.weight = moves(k) ? std::max(1.0, weight_of_block(model.freedom(), all[k])) : 1.0;
    block.centroid =
        state.states[at(k)].position.transpose() * model.basis().values(model.basis().centroid());
    for (const auto& [other, count] : points[k]) {
      block.neighbours.push_back(other);
      block.points.push_back(count);
    }
  }
  return own;
}

double weight_of(const std::vector<PartitionBlock>& own) {
  return std::accumulate(own.begin(), own.end(), 0.0,
                         [](double sum, const PartitionBlock& block) { return sum + block.weight; });
}

/// Largest of the sums of all ranks relative to the mean, minus 1.
double imbalance(const std::vector<double>& sums) {
  const double all = std::accumulate(sums.begin(), sums.end(), 0.0);
  return all > 0.0
             ? *std::max_element(sums.begin(), sums.end()) * static_cast<double>(sums.size()) / all - 1.0
             : 0.0;
}

/// Weight of each rank with other owners. Collective. @param own blocks of this rank
std::vector<double> weights_with(Ranks& ranks, const std::vector<PartitionBlock>& own,
                                 const std::vector<int>& owners) {
  std::vector<double> sums(at(ranks.count()), 0.0);
  for (const PartitionBlock& block : own) sums[at(owners[at(block.block)])] += block.weight;
  return sum_of_ranks(ranks, sums);
}

/// Messages to new owners, by rank.
std::vector<MovedPart> parts_to_send(const BlockSystem& system, const RunState& state,
                                     const FinderState& finder, const std::vector<int>& owners) {
  const BlockShare& share = share_of(system);
  std::vector<MovedPart> parts(at(share.ranks().count()));
  for (const int k : share.own()) {
    if (owners[at(k)] == share.owner(k)) continue;
    parts[at(owners[at(k)])].blocks.push_back(
        {k, state.states[at(k)],
         state.accelerations.empty() ? Eigen::MatrixX3d() : state.accelerations[at(k)],
         state.spin_debts[at(k)], state.sleep.rests[at(k)], finder.tracks[at(k)], finder.divisions[at(k)],
         change_of(system.blocks()[at(k)])});
  }
  // Ranks that have to know a pair which this one has made until now, if one of its blocks goes elsewhere.
  const auto receivers = [&](int a, int b) {
    std::set<int> ranks;
    if (!system.owns_pair(a, b)) return ranks;
    if (owners[at(a)] == share.owner(a) && owners[at(b)] == share.owner(b)) return ranks;
    for (const int block : {a, b})
      if (!system.blocks()[at(block)].fixed()) ranks.insert(owners[at(block)]);
    ranks.erase(share.ranks().own());
    return ranks;
  };
  for (const auto& [blocks, pair] : state.pairs)
    for (const int rank : receivers(blocks[0], blocks[1])) parts[at(rank)].pairs.emplace(blocks, pair);
  for (const PairRecord& record : state.records)
    for (const int rank : receivers(record.a, record.b)) parts[at(rank)].records.push_back(record);
  return parts;
}

std::vector<MovedPart> exchanged(Ranks& ranks, const std::vector<MovedPart>& parts) {
  std::vector<Bytes> messages;
  for (const MovedPart& part : parts) {
    ByteWriter writer;
    if (!part.empty()) writer(part);
    messages.push_back(message_of(writer));
  }
  std::vector<MovedPart> received;
  for (const Bytes& message : ranks.exchange(std::move(messages))) {
    if (message.empty()) continue;
    ByteReader reader(text_of_message(message));
    reader(received.emplace_back());
  }
  return received;
}

/// Takes blocks over, with their models if they were not near before. Collective.
void take_blocks(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches,
                 std::vector<MovedPart>& parts) {
  std::map<int, BlockModel> models;
  do_on_all(shared.share->ranks(), [&] {
    for (const MovedPart& part : parts)
      for (const MovedBlock& moved : part.blocks)
        if (!system.here(moved.block))
          models.emplace(moved.block,
                         shared.keeps_models ? system.blocks()[at(moved.block)] : shared.load(moved.block));
  });
  for (auto& [block, model] : models) set_block_here(system, state, caches, block, std::move(model), true);
  for (const MovedPart& part : parts)
    for (const MovedBlock& moved : part.blocks)
      system.set_here(moved.block, system.blocks()[at(moved.block)], true);
  BlockPartsLibrary library;
  for (MovedPart& part : parts)
    for (MovedBlock& moved : part.blocks)
      apply_change(system, state, caches, moved.block, std::move(moved.change), library);
  ContactFinder& finder = caches.contacts.finder();
  FinderState known = finder.state();
  for (MovedPart& part : parts) {
    for (MovedBlock& moved : part.blocks) {
      const std::size_t k = at(moved.block);
      state.states[k] = std::move(moved.state);
      if (!state.accelerations.empty()) state.accelerations[k] = std::move(moved.acceleration);
      state.spin_debts[k] = moved.spin_debt;
      state.sleep.rests[k] = std::move(moved.rest);
      known.tracks[k] = moved.track;
      known.divisions[k] = std::move(moved.division);
      state.ledger.measure_elastic(system, state.states, moved.block);
      caches.audit.forget(k);
    }
  }
  finder.restore(known);
  // Depths are measured anew.
  state.depths = {};
}

/// Removes what a rank knows of contacts that are not of its own blocks any more.
void forget_contacts_elsewhere(const BlockSystem& system, RunState& state) {
  for (auto& [blocks, pair] : state.pairs) {
    if (system.concerns(blocks[0], blocks[1])) continue;
    PairHistory sums;
    sums.work = pair.work;
    sums.bonded = pair.bonded;
    sums.broken = pair.broken;
    sums.overlap = pair.overlap;
    pair = std::move(sums);
  }
  std::erase_if(state.records,
                [&](const PairRecord& record) { return !system.concerns(record.a, record.b); });
}

void take_contacts(const BlockSystem& system, RunState& state, const ContactFinder& finder,
                   std::vector<MovedPart>& parts) {
  const std::vector<BlockSurface>& surfaces = finder.surfaces();
  const auto known = [&](int a, int b) { return system.here(a) && system.here(b) && system.concerns(a, b); };
  for (MovedPart& part : parts) {
    for (auto& [blocks, history] : part.pairs) {
      const auto [a, b] = blocks;
      if (!known(a, b)) continue;
      PairHistory& pair = state.pairs[blocks] = std::move(history);
      // Paths of ghosts begin when they come near.
      pair.clearance.reset();
      if (pair.cache != nullptr)
        pair.cache = with_rows(*pair.cache, system.blocks()[at(a)], system.blocks()[at(b)], surfaces[at(a)],
                               surfaces[at(b)]);
    }
    for (PairRecord& record : part.records) {
      if (!known(record.a, record.b)) continue;
      std::erase_if(state.records,
                    [&](const PairRecord& old) { return old.a == record.a && old.b == record.b; });
      state.records.push_back(std::move(record));
    }
  }
  std::sort(state.records.begin(), state.records.end(), [](const PairRecord& x, const PairRecord& y) {
    return std::pair(x.a, x.b) < std::pair(y.a, y.b);
  });
}

}  // namespace

double weight_of_rank(const BlockSystem& system, const RunState& state) {
  return weight_of(blocks_of_rank(system, state));
}

bool balance_ranks(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches) {
  const Rebalancing& balance = shared.balance;
  Ranks& ranks = shared.share->ranks();
  // A partition may divide tied blocks.
  if (!system.left_out().empty()) return false;
  if (!balance.partition || ranks.alone() || state.steps == 0 || state.steps % balance.interval != 0)
    return false;
  const std::vector<PartitionBlock> own = blocks_of_rank(system, state);
  std::vector<int> present(at(system.count()));
  for (int k = 0; k < system.count(); ++k) present[at(k)] = shared.share->owner(k);
  const double before = imbalance(weights_with(ranks, own, present));
  if (!(before > balance.beyond)) return false;
  std::vector<int> owners = balance.partition(ranks, own, system.count());
  if (!(imbalance(weights_with(ranks, own, owners)) < 0.5 * before)) return false;
  change_owners(shared, system, state, caches, std::move(owners));
  ++shared.balance.repartitions;
  return true;
}

void change_owners(SharedBlocks& shared, BlockSystem& system, RunState& state, StepCaches& caches,
                   std::vector<int> owners) {
  ContactFinder& finder = caches.contacts.finder();
  tell_bolts(system, state);
  std::vector<MovedPart> parts =
      exchanged(shared.share->ranks(), parts_to_send(system, state, finder.state(), owners));
  const std::vector<int> before = shared.share->own();
  shared.share->set_owners(std::move(owners));
  for (const int block : before)
    if (!system.owns(block)) system.set_here(block, system.blocks()[at(block)], system.here(block));
  take_blocks(shared, system, state, caches, parts);
  forget_contacts_elsewhere(system, state);
  find_ghosts(shared, system, state, caches);
  take_contacts(system, state, finder, parts);
  update_ghost_contacts(system, state);
}

}  // namespace ashlar
