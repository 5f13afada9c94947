#include "solver/step/accept/block_changes.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "mechanics/block/order_change.hpp"

namespace ashlar {

bool carry_blocks(const BlockSystem& system, const RunState& state, StepProblem& problem) {
  problem.carried.clear();
  for (std::size_t k = 0; k < system.blocks().size(); ++k) {
    if (system.blocks()[k].incremental() == nullptr || !system.moving()[k]) continue;
    const Eigen::MatrixX3d change = problem.bodies[k].motion();
    try {
      problem.carried.emplace(k, system.blocks()[k].carried_on(state.states[k].position + change));
    } catch (const std::invalid_argument&) {
      return false;
    } catch (const std::domain_error&) {
      return false;
    }
  }
  return true;
}

void start_carried_step(BlockSystem& system, RunState& state, StepCaches& caches, int block,
                        CarriedBlock next) {
  BlockState& moved = state.states[at(block)];
  const PolynomialBasis& basis = system.blocks()[at(block)].basis();
  const Eigen::MatrixX3d change = moved.position - basis.identity_map();
  for (auto& [blocks, pair] : state.pairs) {
    if (blocks[0] != block && blocks[1] != block) continue;
    pair.memory.carry(blocks[0] == block, [&](const Vector3& point) {
      return Vector3(point + change.transpose() * basis.values(point));
    });
  }
  moved.velocity = next.taken_over(moved.velocity);
  if (!state.accelerations.empty())
    state.accelerations[at(block)] = next.taken_over(state.accelerations[at(block)]);
  system.carry_on(block, std::move(next.model));
  moved.position = system.blocks()[at(block)].basis().identity_map();
  caches.contacts.finder().start_step(block);
  caches.audit.forget(at(block));
  state.ledger.measure_elastic(system, state.states, block);
}

void replace_model(BlockSystem& system, RunState& state, StepCaches& caches, int block, BlockModel model) {
  system.replace(block, std::move(model));
  caches.contacts.finder().renew(block, system.blocks()[at(block)], state.pairs);
  caches.audit.forget(at(block));
  // The systems have as many unknowns as their blocks.
  state.log.counts.factors += caches.factors.islands.counts();
  caches.factors.islands = IslandSolvers(system.settings().linear_method);
}

DroppedByOrder change_order(BlockSystem& system, RunState& state, StepCaches& caches, int block, int order) {
  const std::size_t k = at(block);
  BlockModel next = system.blocks().at(k).with_order(order);
  const OrderChange changed = change_order(system.blocks()[k], state.states[k], next);
  std::vector<Eigen::MatrixX3d>& accelerations = state.accelerations;
  if (!accelerations.empty()) {
    const BlockState accelerated{state.states[k].position, accelerations[k]};
    accelerations[k] = change_order(system.blocks()[k], accelerated, next).state.velocity;
  }
  LedgerKeeper& ledger = state.ledger;
  ledger.measure(system, state.states);
  const double before = ledger.mechanical();
  replace_model(system, state, caches, block, std::move(next));
  state.states[k] = changed.state;
  ledger.measure_elastic(system, state.states, block);
  ledger.measure(system, state.states);
  const double dropped = before - ledger.mechanical();
  ledger.integrator_took(dropped);
  // Near an equilibrium the next iteration needs no more inertia than the last one.
  const bool near = state.statics.balanced || state.statics.level_start.size() != system.blocks().size();
  const double inertia = near ? state.statics.inertia : 0.0;
  state.statics = StaticState{};
  state.statics.inertia = inertia;
  return {changed.dropped_displacement, changed.dropped_velocity, dropped};
}

}  // namespace ashlar
