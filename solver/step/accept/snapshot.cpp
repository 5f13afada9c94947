#include "solver/step/accept/snapshot.hpp"

#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "solver/step/accept/block_changes.hpp"
#include "solver/step/accept/quiet_release.hpp"
#include "solver/step/detect/sleeping_islands.hpp"

namespace ashlar {
namespace {

/// Orders of blocks that were changed in the run.
/// @throws std::invalid_argument if the snapshot was taken of other blocks
std::map<int, int> changed_orders(const BlockSystem& system, const RunState& state,
                                  const SimulationSnapshot& snapshot) {
  const std::vector<BlockState>& states = snapshot.run.states;
  bool fits = states.size() == system.blocks().size() && snapshot.run.sleep.rests.size() == states.size();
  std::map<int, int> orders;
  for (int k = 0; fits && k < system.count(); ++k) {
    const Eigen::Index rows = states[at(k)].position.rows();
    const bool incremental = system.blocks()[at(k)].incremental() != nullptr;
    fits = states[at(k)].velocity.rows() == rows && snapshot.carried.contains(k) == incremental;
    if (rows == state.states[at(k)].position.rows()) continue;
    int order = 1;
    while (order < PolynomialBasis::max_order && polynomial_count(order) < rows) ++order;
    fits = fits && polynomial_count(order) == rows && !system.blocks()[at(k)].fixed() && !incremental;
    orders.emplace(k, order);
  }
  for (const auto& [place, factor] : snapshot.load_factors)
    fits =
        fits && at(place[0]) < states.size() && at(place[1]) < system.blocks()[at(place[0])].loads().size();
  for (const auto& [k, reaction] : snapshot.reactions)
    fits = fits && k >= 0 && k < system.count() && system.blocks()[at(k)].quiet() &&
           reaction.rows() == states[at(k)].position.rows();
  if (!fits) throw std::invalid_argument("the snapshot has other blocks");
  return orders;
}

/// A copy of all members but pairs and records.
RunState state_without_pairs(const RunState& state) {
  const auto& [clock, next_step, steps, remembers_statics, states, accelerations, spin_debts, pairs, depths,
               bolts, statics, sleep, ledger, report, records, extremes, log] = state;
  return {clock, next_step, steps, remembers_statics, states, accelerations, spin_debts,
          {},    depths,    bolts, statics,           sleep,  ledger,        report,
          {},    extremes,  log};
}

}  // namespace

SimulationCounts counts_of(const RunState& state, const StepCaches& caches) {
  SimulationCounts counts = state.log.counts;
  counts.finder = caches.contacts.finder().counts();
  counts.factors += caches.factors.counts();
  return counts;
}

SimulationSnapshot snapshot_of(const BlockSystem& system, const RunState& state, const StepCaches& caches) {
  SimulationSnapshot result = snapshot_without_pairs(system, state, caches);
  result.run.pairs = state.pairs;
  result.run.records = state.records;
  return result;
}

SimulationSnapshot snapshot_without_pairs(const BlockSystem& system, const RunState& state,
                                          const StepCaches& caches) {
  SimulationSnapshot result{state_without_pairs(state),
                            {},
                            caches.contacts.finder().state(),
                            caches.factors.islands.kept(),
                            system.load_factors(),
                            system.reactions()};
  result.run.log.counts = counts_of(state, caches);
  for (int k = 0; k < system.count(); ++k) {
    const BlockModel& block = system.blocks()[at(k)];
    if (block.incremental() != nullptr) result.carried.emplace(k, block.carried());
  }
  return result;
}

SimulationSnapshot without_pairs(const SimulationSnapshot& snapshot) {
  const auto& [run, carried, finder, factors, load_factors, reactions] = snapshot;
  return {state_without_pairs(run), carried, finder, factors, load_factors, reactions};
}

void restore(BlockSystem& system, RunState& state, StepCaches& caches, const SimulationSnapshot& snapshot) {
  if (snapshot.run.bolts.size() != system.bolts().size())
    throw std::invalid_argument("a snapshot of other bolts");
  const std::map<int, int> orders = changed_orders(system, state, snapshot);
  FactorCache factors(system.settings().linear_method);
  factors.islands.restore(snapshot.factors);
  for (const auto& [k, order] : orders)
    replace_model(system, state, caches, k, system.blocks()[at(k)].with_order(order));
  set_reactions(system, state, caches, snapshot.reactions);
  for (const auto& [place, factor] : system.load_factors()) system.set_load_factor(place[0], place[1], 1.0);
  for (const auto& [place, factor] : snapshot.load_factors)
    system.set_load_factor(place[0], place[1], factor);
  state = snapshot.run;
  hold_sleepers(system, state.sleep);
  // Fixed and sleeping blocks are placed once.
  for (const SleepingIsland& island : state.sleep.islands)
    for (const int block : island.blocks) caches.audit.forget(at(block));
  for (const auto& [block, shape] : snapshot.carried) {
    system.carry_on(block, system.blocks()[at(block)].with_shape(shape));
    caches.contacts.finder().start_step(block);
  }
  caches.contacts.finder().restore(snapshot.finder);
  for (auto& [blocks, pair] : state.pairs) {
    const auto [a, b] = blocks;
    const std::vector<BlockSurface>& surfaces = caches.contacts.finder().surfaces();
    if (pair.cache != nullptr && pair.cache->rows == nullptr)
      pair.cache = with_rows(*pair.cache, system.blocks().at(at(a)), system.blocks().at(at(b)),
                             surfaces.at(at(a)), surfaces.at(at(b)));
  }
  caches.factors = std::move(factors);
  state.ledger.measure_elastic(system, state.states);
}

}  // namespace ashlar
