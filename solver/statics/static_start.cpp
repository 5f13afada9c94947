// Motion that starts from the static state of the whole scene: a static analysis under gravity and the loads
// at time 0 comes before the first step. What it leaves is where blocks are and what contacts remember:
// bonds, slip of springs, forces of multipliers, so that the first step finds all forces in balance. What it
// did to get there, energies, work and rejected iterations, is no part of the motion.
//
// Blocks that nothing holds, in the air or in contact with each other only, have no static state: they stay
// as placed, as if they were fixed, until the motion begins.
#include "solver/run/checkpoint.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

StaticStatus Simulation::start_from_statics(const std::function<bool()>& goes_on) {
  const SimulationSnapshot as_placed = snapshot();
  const std::vector<bool> moving = moving_;
  for (const std::vector<int>& blocks : loose_blocks())
    for (const int block : blocks) moving_[static_cast<std::size_t>(block)] = false;
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing && goes_on()) status = static_step(time());
  moving_ = moving;
  if (status != StaticStatus::equilibrium) {
    restore(as_placed);
    return status;
  }
  for (std::size_t k = 0; k < blocks_.size(); ++k) states_[k].velocity = as_placed.states[k].velocity;
  static_ = StaticState{};
  ledger_ = Ledger{};
  for (const PairRecord& record : records_)
    for (const PointResponse& response : record.responses) ledger_.contact += response.energy();
  contact_work_.clear();
  for (PairRecord& record : records_) record.work = 0.0;
  rejections_.clear();
  steps_ = 0;
  remembers_statics_ = true;
  note_elastic_energies();
  measure_energies(ledger_);
  start_balance_ = ledger_.balance();
  largest_step_residual_ = largest_energy_ = 0.0;
  largest_penetration_ = report_.penetration;
  deepest_ = DeepestPoint{};
  sliding_friction_ = FrictionTally{};
  return status;
}

}  // namespace ashlar
