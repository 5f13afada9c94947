#include "solver/step/snapshot.hpp"

#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "solver/step/block_changes.hpp"
#include "solver/step/quiet_release.hpp"
#include "solver/step/sleeping_islands.hpp"

namespace ashlar {
namespace {

/// Orders of blocks that were changed in the run.
/// @throws std::invalid_argument if the snapshot was taken of other blocks
std::map<int, int> changed_orders(const RunContext& run, const SimulationSnapshot& snapshot) {
  const std::vector<BlockState>& states = snapshot.run.states;
  bool fits = states.size() == run.blocks().size() && snapshot.run.sleep.rests.size() == states.size();
  std::map<int, int> orders;
  for (int k = 0; fits && k < run.system.count(); ++k) {
    const Eigen::Index rows = states[at(k)].position.rows();
    const bool incremental = run.blocks()[at(k)].incremental() != nullptr;
    fits = states[at(k)].velocity.rows() == rows && snapshot.carried.contains(k) == incremental;
    if (rows == run.state.states[at(k)].position.rows()) continue;
    int order = 1;
    while (order < PolynomialBasis::max_order && polynomial_count(order) < rows) ++order;
    fits = fits && polynomial_count(order) == rows && !run.blocks()[at(k)].fixed() && !incremental;
    orders.emplace(k, order);
  }
  for (const auto& [place, factor] : snapshot.load_factors)
    fits = fits && at(place[0]) < states.size() && at(place[1]) < run.blocks()[at(place[0])].loads().size();
  for (const auto& [k, reaction] : snapshot.reactions)
    fits = fits && k >= 0 && k < run.system.count() && run.blocks()[at(k)].quiet() &&
           reaction.rows() == states[at(k)].position.rows();
  if (!fits) throw std::invalid_argument("the snapshot has other blocks");
  return orders;
}

}  // namespace

SimulationCounts counts_of(const RunState& state, const StepContacts& contacts, const FactorCache& factors) {
  SimulationCounts counts = state.log.counts;
  counts.finder = contacts.finder().counts();
  counts.factors += factors.counts();
  return counts;
}

SimulationSnapshot snapshot_of(const BlockSystem& system, const RunState& state, const StepContacts& contacts,
                               const FactorCache& factors) {
  SimulationSnapshot result{state,
                            {},
                            contacts.finder().state(),
                            factors.islands.kept(),
                            system.load_factors(),
                            system.reactions()};
  result.run.log.counts = counts_of(state, contacts, factors);
  for (int k = 0; k < system.count(); ++k) {
    const BlockModel& block = system.blocks()[at(k)];
    if (block.incremental() != nullptr) result.carried.emplace(k, block.carried());
  }
  return result;
}

SimulationSnapshot snapshot_of(const RunContext& run) {
  return snapshot_of(run.system, run.state, run.contacts, run.factors);
}

void restore(const RunContext& run, const SimulationSnapshot& snapshot) {
  if (snapshot.run.bolts.size() != run.system.bolts().size())
    throw std::invalid_argument("a snapshot of other bolts");
  const std::map<int, int> orders = changed_orders(run, snapshot);
  FactorCache factors(run.settings().linear_method);
  factors.islands.restore(snapshot.factors);
  for (const auto& [k, order] : orders) replace_model(run, k, run.blocks()[at(k)].with_order(order));
  set_reactions(run, snapshot.reactions);
  for (const auto& [place, factor] : run.system.load_factors())
    run.system.set_load_factor(place[0], place[1], 1.0);
  for (const auto& [place, factor] : snapshot.load_factors)
    run.system.set_load_factor(place[0], place[1], factor);
  run.state = snapshot.run;
  hold_sleepers(run.system, run.state.sleep);
  // Fixed and sleeping blocks are placed once.
  for (const SleepingIsland& island : run.state.sleep.islands)
    for (const int block : island.blocks) run.audit.forget(at(block));
  for (const auto& [block, shape] : snapshot.carried) {
    run.system.carry_on(block, run.blocks()[at(block)].with_shape(shape));
    run.contacts.finder().start_step(block);
  }
  run.contacts.finder().restore(snapshot.finder);
  for (auto& [blocks, pair] : run.state.pairs) {
    const auto [a, b] = blocks;
    const std::vector<BlockSurface>& surfaces = run.contacts.finder().surfaces();
    if (pair.cache != nullptr && pair.cache->rows == nullptr)
      pair.cache = with_rows(*pair.cache, run.blocks().at(at(a)), run.blocks().at(at(b)), surfaces.at(at(a)),
                             surfaces.at(at(b)));
  }
  run.factors = std::move(factors);
  run.state.ledger.measure_elastic(run.system, run.state.states);
}

}  // namespace ashlar
