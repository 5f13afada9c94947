#include "solver/step/block_changes.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "mechanics/block/order_change.hpp"

namespace ashlar {

bool carry_blocks(const RunContext& run, StepProblem& problem) {
  problem.carried.clear();
  for (std::size_t k = 0; k < run.blocks().size(); ++k) {
    if (run.blocks()[k].incremental() == nullptr || !run.system.moving()[k]) continue;
    const Eigen::MatrixX3d change = problem.bodies[k].motion();
    try {
      problem.carried.emplace(k, run.blocks()[k].carried_on(run.state.states[k].position + change));
    } catch (const std::invalid_argument&) {
      return false;
    } catch (const std::domain_error&) {
      return false;
    }
  }
  return true;
}

void start_carried_step(const RunContext& run, int block, CarriedBlock next) {
  BlockState& state = run.state.states[at(block)];
  const PolynomialBasis& basis = run.blocks()[at(block)].basis();
  const Eigen::MatrixX3d change = state.position - basis.identity_map();
  for (auto& [blocks, pair] : run.state.pairs) {
    if (blocks[0] != block && blocks[1] != block) continue;
    pair.memory.carry(blocks[0] == block, [&](const Vector3& point) {
      return Vector3(point + change.transpose() * basis.values(point));
    });
  }
  state.velocity = next.taken_over(state.velocity);
  if (!run.state.accelerations.empty())
    run.state.accelerations[at(block)] = next.taken_over(run.state.accelerations[at(block)]);
  run.system.carry_on(block, std::move(next.model));
  state.position = run.blocks()[at(block)].basis().identity_map();
  run.contacts.finder().start_step(block);
  run.audit.forget(at(block));
  run.state.ledger.measure_elastic(run.system, run.state.states, block);
}

void replace_model(const RunContext& run, int block, BlockModel model) {
  run.system.replace(block, std::move(model));
  run.contacts.finder().renew(block, run.blocks()[at(block)], run.state.pairs);
  run.audit.forget(at(block));
  // The systems have as many unknowns as their blocks.
  run.state.log.counts.factors += run.factors.islands.counts();
  run.factors.islands = IslandSolvers(run.settings().linear_method);
}

DroppedByOrder change_order(const RunContext& run, int block, int order) {
  const std::size_t k = at(block);
  BlockModel next = run.blocks().at(k).with_order(order);
  const OrderChange changed = change_order(run.blocks()[k], run.state.states[k], next);
  std::vector<Eigen::MatrixX3d>& accelerations = run.state.accelerations;
  if (!accelerations.empty()) {
    const BlockState accelerated{run.state.states[k].position, accelerations[k]};
    accelerations[k] = change_order(run.blocks()[k], accelerated, next).state.velocity;
  }
  LedgerKeeper& ledger = run.state.ledger;
  ledger.measure(run.system, run.state.states);
  const double before = ledger.mechanical();
  replace_model(run, block, std::move(next));
  run.state.states[k] = changed.state;
  ledger.measure_elastic(run.system, run.state.states, block);
  ledger.measure(run.system, run.state.states);
  const double dropped = before - ledger.mechanical();
  ledger.integrator_took(dropped);
  run.state.statics = StaticState{};
  return {changed.dropped_displacement, changed.dropped_velocity, dropped};
}

}  // namespace ashlar
