#include "solver/shared/gathered_run.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "geometry/index.hpp"
#include "solver/archived_geometry.hpp"
#include "solver/shared/shared_step.hpp"

namespace ashlar {
namespace {

/// Pairs of all ranks in one exchange: a pair of bricks takes 10 to 20 kB.
constexpr int records_at_a_time = 512;

/// Null: one rank has all blocks.
const BlockShare* share_of_run(const Simulation& simulation) {
  const SharedBlocks* shared = simulation.shared_blocks();
  return shared == nullptr ? nullptr : shared->share.get();
}

/// Adds all numbers of a struct.
template <class Struct>
void add_all(const Struct& one, Struct& sum) {
  if constexpr (std::is_arithmetic_v<Struct>) {
    sum += one;
  } else {
    with_members(sum, [&one](auto&... of_sum) {
      with_members(one, [&](const auto&... of_one) { (add_all(of_one, of_sum), ...); });
    });
  }
}

void add(const SimulationCounts& one, SimulationCounts& sum) {
  add_all(one, sum);
  // All ranks count islands that sleep.
  sum.islands_put_to_sleep = one.islands_put_to_sleep;
}

void add(const StepReport& one, StepReport& sum) {
  sum.step = one.step;
  sum.iterations = std::max(sum.iterations, one.iterations);
  sum.open += one.open;
  sum.locked += one.locked;
  sum.sliding += one.sliding;
  sum.penetration = std::max(sum.penetration, one.penetration);
  sum.depth = std::max(sum.depth, one.depth);
}

void add(const ContactExtremes& one, ContactExtremes& sum) {
  sum.penetration = std::max(sum.penetration, one.penetration);
  if (one.deepest.depth > sum.deepest.depth) sum.deepest = one.deepest;
  add_all(one.sliding_friction, sum.sliding_friction);
  add_all(one.dilating_slip, sum.dilating_slip);
  if (one.most_closed.share > sum.most_closed.share) sum.most_closed = one.most_closed;
  sum.impacts = one.impacts;
  sum.turn.limited = std::max(sum.turn.limited, one.turn.limited);  // all ranks count all
  if (one.turn.angle > sum.turn.angle)
    sum.turn = {one.turn.block, one.turn.angle, one.turn.time, sum.turn.limited};
}

RunTotals totals_here(const Simulation& simulation, const ShownContacts& shown) {
  return {simulation.ledger(),           simulation.report(), simulation.extremes(), simulation.momentum(),
          simulation.angular_momentum(), simulation.counts(), simulation.unknowns(), shown};
}

}  // namespace

RunTotals totals_of_run(const Simulation& simulation, const ShownContacts& shown) {
  RunTotals here = totals_here(simulation, shown);
  const BlockShare* share = share_of_run(simulation);
  if (share == nullptr) return here;
  RunTotals sum;
  for (const RunTotals& one : values_of_ranks(share->ranks(), here)) {
    add_all(one.ledger, sum.ledger);
    add(one.report, sum.report);
    add(one.extremes, sum.extremes);
    sum.momentum += one.momentum;
    sum.angular_momentum += one.angular_momentum;
    add(one.counts, sum.counts);
    sum.unknowns += one.unknowns;
    add_all(one.shown, sum.shown);
  }
  return sum;
}

std::vector<BlockState> states_of_run(const Simulation& simulation, const ResultNeeds& needs) {
  const BlockShare* share = share_of_run(simulation);
  std::vector<BlockState> states = simulation.states();
  if (share == nullptr) return states;
  send_to_first(
      share->ranks(),
      [&](ByteWriter& writer) {
        for (const int block : needs.all ? share->own() : needs.blocks)
          if (share->owns(block)) writer(block, simulation.states()[at(block)]);
      },
      [&](ByteReader& reader, int) {
        while (!reader.at_end()) {
          int block = -1;
          reader(block);
          reader(states.at(at(block)));
        }
      });
  if (share->ranks().own() != 0) states.clear();
  return states;
}

std::vector<PairRecord> contacts_of_run(const Simulation& simulation, const ResultNeeds& needs) {
  const BlockSystem& system = simulation.system();
  if (system.exchange().alone()) return simulation.contacts();
  std::vector<const PairRecord*> own;
  const auto needed = [&](const PairKey& blocks) {
    return needs.all || std::binary_search(needs.pairs.begin(), needs.pairs.end(), blocks);
  };
  for (const PairRecord& record : simulation.contacts())
    if (system.owns_pair(record.a, record.b) && needed({record.a, record.b})) own.push_back(&record);
  Ranks& ranks = share_of(system).ranks();
  std::vector<PairRecord> all;
  if (ranks.own() == 0)
    for (const PairRecord* record : own) all.push_back(*record);
  std::size_t sent = 0;
  // Messages with all pairs would need as much memory again on the first rank.
  const std::size_t most = at(std::max(1, records_at_a_time / ranks.count()));
  while (any_rank(ranks, ranks.own() > 0 && sent < own.size())) {
    send_to_first(
        ranks,
        [&](ByteWriter& writer) {
          for (std::size_t left = most; left > 0 && sent < own.size(); --left) writer(*own[sent++]);
        },
        [&](ByteReader& reader, int) {
          while (!reader.at_end()) reader(all.emplace_back());
        });
  }
  std::sort(all.begin(), all.end(), [](const PairRecord& x, const PairRecord& y) {
    return std::pair(x.a, x.b) < std::pair(y.a, y.b);
  });
  return all;
}

std::vector<PairBonds> bonds_of_run(const Simulation& simulation) {
  const BlockSystem& system = simulation.system();
  std::vector<PairBonds> own;
  for (const auto& [blocks, pair] : simulation.histories())
    if ((pair.bonded > 0.0 || pair.broken > 0.0) && system.owns_pair(blocks[0], blocks[1]))
      own.push_back({blocks, pair.bonded, pair.broken});
  if (system.exchange().alone()) return own;
  Ranks& ranks = share_of(system).ranks();
  std::vector<PairBonds> all = ranks.own() == 0 ? own : std::vector<PairBonds>();
  send_to_first(
      ranks, [&](ByteWriter& writer) { writer(own); },
      [&](ByteReader& reader, int) {
        std::vector<PairBonds> others;
        reader(others);
        all.insert(all.end(), others.begin(), others.end());
      });
  return all;
}

std::map<PairKey, std::vector<char>> points_without_strength_of_run(const Simulation& simulation) {
  const BlockSystem& system = simulation.system();
  std::map<PairKey, std::vector<char>> own;
  for (const PairRecord& record : simulation.contacts()) {
    if (!system.owns_pair(record.a, record.b)) continue;
    std::vector<char> lost = simulation.points_without_strength(record);
    if (std::find(lost.begin(), lost.end(), 1) != lost.end()) own[{record.a, record.b}] = std::move(lost);
  }
  if (system.exchange().alone()) return own;
  Ranks& ranks = share_of(system).ranks();
  std::map<PairKey, std::vector<char>> all;
  send_to_first(
      ranks, [&](ByteWriter& writer) { writer(own); },
      [&](ByteReader& reader, int) {
        std::map<PairKey, std::vector<char>> others;
        reader(others);
        all.merge(others);
      });
  if (ranks.own() == 0) all.merge(own);
  return all;
}

std::vector<RankWork> work_of_ranks(const Simulation& simulation, const ProcessUse& use) {
  const BlockSystem& system = simulation.system();
  RankWork work;
  work.seconds = simulation.seconds();
  work.use = use;
  for (const PairRecord& record : simulation.contacts()) {
    const auto elsewhere = [&](int block) {
      return !system.owns(block) && !system.blocks()[at(block)].fixed();
    };
    const bool owned = system.owns_pair(record.a, record.b);
    work.pairs += owned ? 1 : 0;
    work.border_pairs +=
        system.concerns(record.a, record.b) && (elsewhere(record.a) || elsewhere(record.b)) ? 1 : 0;
  }
  work.unknowns = system.unknowns();
  work.points = simulation.own_counts().contact_points;
  for (const auto& [blocks, pair] : simulation.histories()) {
    if (!system.owns_pair(blocks[0], blocks[1])) continue;
    work.broken_pairs += pair.broken > 0.0 ? 1 : 0;
    work.broken_area += pair.broken;
    work.bonded_area += pair.bonded;
  }
  const BlockShare* share = share_of_run(simulation);
  if (share == nullptr) {
    work.own = system.count();
    return {work};
  }
  work.own = static_cast<int>(share->own().size());
  work.ghosts = static_cast<int>(share->ghosts().size());
  work.traffic = share->ranks().traffic();
  work.shared = simulation.shared_blocks()->earlier;
  work.shared += share->solver().work();
  work.shared += share->step_solver().work();
  work.for_results = simulation.shared_blocks()->for_results;
  work.ghost_searches = simulation.shared_blocks()->searches;
  work.repartitions = simulation.shared_blocks()->balance.repartitions;
  work.weight = simulation.own_weight();
  return values_of_ranks(share->ranks(), work);
}

}  // namespace ashlar
