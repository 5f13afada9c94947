#include "solver/run/gathered_run.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "geometry/index.hpp"
#include "solver/archived_geometry.hpp"

namespace ashlar {
namespace {

SimulationCounts& operator+=(SimulationCounts& sum, const SimulationCounts& one) {
  FinderCounts& finder = sum.finder;
  finder.block_pairs_tested += one.finder.block_pairs_tested;
  finder.convex_pairs += one.finder.convex_pairs;
  finder.block_pairs_skipped += one.finder.block_pairs_skipped;
  finder.block_pairs_kept += one.finder.block_pairs_kept;
  finder.block_pairs_far += one.finder.block_pairs_far;
  finder.motions_checked += one.finder.motions_checked;
  finder.divisions += one.finder.divisions;
  finder.divisions_at_limit += one.finder.divisions_at_limit;
  finder.predicates.filter += one.finder.predicates.filter;
  finder.predicates.exact += one.finder.predicates.exact;
  sum.contact_points += one.contact_points;
  sum.open_close_iterations += one.open_close_iterations;
  sum.open_close_fallbacks += one.open_close_fallbacks;
  sum.passing_contacts += one.passing_contacts;
  // All ranks count islands that sleep.
  sum.islands_put_to_sleep = one.islands_put_to_sleep;
  sum.sleeping_block_steps += one.sleeping_block_steps;
  sum.factors += one.factors;
  return sum;
}

void add(const Ledger& one, Ledger& sum) {
  sum.kinetic += one.kinetic;
  sum.elastic += one.elastic;
  sum.gravity += one.gravity;
  sum.contact += one.contact;
  sum.friction += one.friction;
  sum.damping += one.damping;
  sum.applied += one.applied;
  sum.numerical += one.numerical;
  sum.redetection_gained += one.redetection_gained;
  sum.redetection_lost += one.redetection_lost;
  sum.residual += one.residual;
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
  sum.sliding_friction.due += one.sliding_friction.due;
  sum.sliding_friction.acted += one.sliding_friction.acted;
  sum.dilating_slip.all += one.dilating_slip.all;
  sum.dilating_slip.in_flight += one.dilating_slip.in_flight;
}

RunTotals totals_here(const Simulation& simulation) {
  return {simulation.ledger(),
          simulation.report(),
          {simulation.largest_penetration(), simulation.deepest(), simulation.sliding_friction(),
           simulation.dilating_slip()},
          simulation.momentum(),
          simulation.angular_momentum(),
          simulation.counts(),
          simulation.unknowns()};
}

/// Values of own blocks or pairs, on rank 0. @param write (archive). @param read (archive), once for each other rank
template <class Write, class Read>
void send_to_first(Ranks& ranks, const Write& write, const Read& read) {
  std::vector<Bytes> messages(at(ranks.count()));
  if (ranks.own() != 0) {
    ByteWriter writer;
    write(writer);
    const std::string text = writer.take();
    const auto bytes = std::as_bytes(std::span(text));
    messages[0].assign(bytes.begin(), bytes.end());
  }
  const std::vector<Bytes> received = ranks.exchange(std::move(messages));
  if (ranks.own() != 0) return;
  for (const Bytes& message : received) {
    if (message.empty()) continue;
    ByteReader reader({reinterpret_cast<const char*>(message.data()), message.size()});
    read(reader);
  }
}

}  // namespace

RunTotals totals_of_run(const Simulation& simulation) {
  const RunTotals here = totals_here(simulation);
  const BlockShare* share = simulation.system().share();
  if (share == nullptr) return here;
  RunTotals sum;
  for (const RunTotals& one : values_of_ranks(share->ranks(), here)) {
    add(one.ledger, sum.ledger);
    add(one.report, sum.report);
    add(one.extremes, sum.extremes);
    sum.momentum += one.momentum;
    sum.angular_momentum += one.angular_momentum;
    sum.counts += one.counts;
    sum.unknowns += one.unknowns;
  }
  return sum;
}

std::vector<BlockState> states_of_run(const Simulation& simulation) {
  const BlockShare* share = simulation.system().share();
  std::vector<BlockState> states = simulation.states();
  if (share == nullptr) return states;
  send_to_first(
      share->ranks(),
      [&](ByteWriter& writer) {
        for (const int block : share->own()) writer(block, simulation.states()[at(block)]);
      },
      [&](ByteReader& reader) {
        while (!reader.at_end()) {
          int block = -1;
          reader(block);
          reader(states.at(at(block)));
        }
      });
  if (share->ranks().own() != 0) states.clear();
  return states;
}

std::vector<PairRecord> contacts_of_run(const Simulation& simulation) {
  const BlockSystem& system = simulation.system();
  if (system.share() == nullptr) return simulation.contacts();
  std::vector<PairRecord> own;
  for (const PairRecord& record : simulation.contacts())
    if (system.owns_pair(record.a, record.b)) own.push_back(record);
  Ranks& ranks = system.share()->ranks();
  std::vector<PairRecord> all = ranks.own() == 0 ? own : std::vector<PairRecord>();
  send_to_first(
      ranks, [&](ByteWriter& writer) { writer(own); },
      [&](ByteReader& reader) {
        std::vector<PairRecord> others;
        reader(others);
        for (PairRecord& record : others) all.push_back(std::move(record));
      });
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
  if (system.share() == nullptr) return own;
  Ranks& ranks = system.share()->ranks();
  std::vector<PairBonds> all = ranks.own() == 0 ? own : std::vector<PairBonds>();
  send_to_first(
      ranks, [&](ByteWriter& writer) { writer(own); },
      [&](ByteReader& reader) {
        std::vector<PairBonds> others;
        reader(others);
        all.insert(all.end(), others.begin(), others.end());
      });
  return all;
}

std::vector<RankWork> work_of_ranks(const Simulation& simulation) {
  const BlockSystem& system = simulation.system();
  RankWork work;
  work.seconds = simulation.seconds();
  for (const PairRecord& record : simulation.contacts())
    work.pairs += system.owns_pair(record.a, record.b) ? 1 : 0;
  for (const auto& [blocks, pair] : simulation.histories()) {
    if (!system.owns_pair(blocks[0], blocks[1])) continue;
    work.broken_pairs += pair.broken > 0.0 ? 1 : 0;
    work.broken_area += pair.broken;
    work.bonded_area += pair.bonded;
  }
  const BlockShare* share = system.share();
  if (share == nullptr) {
    work.own = system.count();
    return {work};
  }
  work.own = static_cast<int>(share->own().size());
  work.ghosts = static_cast<int>(share->ghosts().size());
  work.traffic = share->ranks().traffic();
  return values_of_ranks(share->ranks(), work);
}

}  // namespace ashlar
