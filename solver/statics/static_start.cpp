#include "solver/statics/static_start.hpp"

#include "solver/statics/static_step.hpp"
#include "solver/step/accepted_bolts.hpp"
#include "solver/step/snapshot.hpp"

namespace ashlar {

StaticStatus start_from_statics(const RunContext& run, const std::function<bool()>& goes_on) {
  const SimulationSnapshot as_placed = snapshot_of(run);
  for (const std::vector<int>& blocks : loose_blocks(run)) run.system.hold(blocks);
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing && goes_on())
    status = static_step(run, run.state.time(), run.settings().statics.displacement_limit);
  run.system.let_go();
  if (status != StaticStatus::equilibrium) {
    restore(run, as_placed);
    return status;
  }
  RunState& state = run.state;
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
  in_springs += energy_of_ties(run);
  state.log.rejections.clear();
  state.steps = 0;
  state.remembers_statics = true;
  state.ledger.clear(in_springs);
  state.ledger.start(run.system, state.states);
  state.extremes = ContactExtremes{
      .penetration = state.report.penetration, .deepest = {}, .sliding_friction = {}, .dilating_slip = {}};
  return status;
}

double energy_of_ties(const RunContext& run) {
  double sum = 0.0;
  if (run.system.ties().empty()) return sum;
  for (const ContactPair& pair : run.contacts.pairs(run.system, run.state, {}, PairUse::statics))
    if (pair.tied()) sum += pair.start_energy();
  return sum;
}

}  // namespace ashlar
