// Blocks whose model changes between steps.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "mechanics/block/order_change.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

bool Simulation::any_incremental() const {
  return std::any_of(blocks_.begin(), blocks_.end(),
                     [](const BlockModel& block) { return block.incremental() != nullptr; });
}

bool Simulation::carry_blocks(Trial& trial) const {
  trial.carried.clear();
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (blocks_[k].incremental() == nullptr) continue;
    const Eigen::MatrixX3d change = trial.bodies[k].motion();
    try {
      trial.carried.emplace(k, blocks_[k].carried_on(states_[k].position + change));
    } catch (const std::invalid_argument&) {
      return false;
    } catch (const std::domain_error&) {
      return false;
    }
  }
  return true;
}

void Simulation::start_carried_step(std::size_t k, CarriedBlock next) {
  const Eigen::MatrixX3d change = states_[k].position - blocks_[k].basis().identity_map();
  const int block = static_cast<int>(k);
  for (auto& [blocks, memory] : memory_) {
    if (blocks[0] != block && blocks[1] != block) continue;
    memory.carry(blocks[0] == block, [&](const Vector3& point) {
      return Vector3(point + change.transpose() * blocks_[k].basis().values(point));
    });
  }
  states_[k].velocity = next.taken_over(states_[k].velocity);
  if (!accelerations_.empty()) accelerations_[k] = next.taken_over(accelerations_[k]);
  blocks_[k] = std::move(next.model);
  states_[k].position = blocks_[k].basis().identity_map();
  finder_.start_step(block);
  audit_.forget(k);
  note_elastic_energy(k);
}

void Simulation::replace_model(std::size_t k, BlockModel model) {
  blocks_[k] = std::move(model);
  finder_.renew(static_cast<int>(k), blocks_[k]);
  audit_.forget(k);
  note_gradients(k);
  roundoff_force_[k] = blocks_[k].force_rounding();
  // Systems are as large as their blocks' unknowns.
  counts_.factors += solvers_.counts();
  solvers_ = IslandSolvers();
}

DroppedByOrder Simulation::change_order(int block, int order) {
  const auto k = static_cast<std::size_t>(block);
  BlockModel next = blocks_.at(k).with_order(order);
  const OrderChange changed = ashlar::change_order(blocks_[k], states_[k], next);
  if (!accelerations_.empty()) {
    const BlockState accelerated{states_[k].position, accelerations_[k]};
    accelerations_[k] = ashlar::change_order(blocks_[k], accelerated, next).state.velocity;
  }
  const auto energy = [&] { return ledger_.kinetic + ledger_.elastic + ledger_.gravity; };
  measure_energies(ledger_);
  const double before = energy();
  replace_model(k, std::move(next));
  states_[k] = changed.state;
  note_elastic_energy(k);
  measure_energies(ledger_);
  const double dropped = before - energy();
  ledger_.numerical += dropped;
  static_ = StaticState{};
  return {changed.dropped_displacement, changed.dropped_velocity, dropped};
}

}  // namespace ashlar
