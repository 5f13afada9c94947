#include "solver/statics/static_start.hpp"

#include "solver/statics/static_step.hpp"
#include "solver/step/accepted_bolts.hpp"
#include "solver/step/snapshot.hpp"

namespace ashlar {

StaticStatus start_from_statics(const RunContext& run, const std::function<bool()>& goes_on) {
  BlockSystem& system = run.system;
  RunState& state = run.state;
  const SimulationSnapshot as_placed = snapshot_of(system, state, run.caches);
  const double far = system.settings().statics.displacement_limit;
  for (const std::vector<int>& blocks : loose_blocks(system, state, run.caches.contacts)) system.hold(blocks);
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing && goes_on()) status = static_step(run, state.time(), far);
  system.let_go();
  if (status != StaticStatus::equilibrium) {
    restore(system, state, run.caches, as_placed);
    return status;
  }
  for (std::size_t k = 0; k < state.states.size(); ++k)
    state.states[k].velocity = as_placed.run.states[k].velocity;
  state.statics = StaticState{};
  double in_springs = 0.0;
  for (PairRecord& record : state.records) {
    for (const PointResponse& response : record.responses) in_springs += response.energy();
    record.work = 0.0;
  }
  for (auto& [blocks, pair] : state.pairs) pair.work = 0.0;
  commit_bolts(state);
  for (const BoltState& bolt : state.bolts) in_springs += bolt.stored;
  in_springs += energy_of_ties(system, state, run.caches.contacts);
  state.log.rejections.clear();
  state.steps = 0;
  state.remembers_statics = true;
  state.ledger.clear(in_springs);
  state.ledger.start(system, state.states);
  state.extremes = ContactExtremes{
      .penetration = state.report.penetration, .deepest = {}, .sliding_friction = {}, .dilating_slip = {}};
  return status;
}

double energy_of_ties(const BlockSystem& system, RunState& state, StepContacts& contacts) {
  double sum = 0.0;
  if (system.ties().empty()) return sum;
  for (const ContactPair& pair : contacts.pairs(system, state, {}, PairUse::statics))
    if (pair.tied()) sum += pair.start_energy();
  return sum;
}

}  // namespace ashlar
