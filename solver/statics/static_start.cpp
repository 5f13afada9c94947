#include "solver/statics/static_start.hpp"

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"
#include "solver/statics/loose_blocks.hpp"
#include "solver/statics/static_step.hpp"
#include "solver/step/accept/accepted_bolts.hpp"
#include "solver/step/accept/snapshot.hpp"
#include "solver/step/island/bolts_of_run.hpp"

namespace ashlar {

StaticStatus start_from_statics(const RunContext& run, const std::function<bool()>& may_continue) {
  BlockSystem& system = run.system;
  RunState& state = run.state;
  const SimulationSnapshot as_placed = snapshot_of(system, state, run.caches);
  const double far = system.settings().statics.displacement_limit;
  for (const std::vector<int>& blocks : loose_blocks(system, state, run.caches.contacts))
    system.hold_loose(blocks);
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing && may_continue()) status = static_step(run, state.time(), far);
  system.let_go_loose();
  if (status != StaticStatus::equilibrium) {
    system.exchange().restore_start(run, as_placed);
    return status;
  }
  for (int k = 0; k < system.count(); ++k)
    if (system.owns(k)) state.states[at(k)].velocity = as_placed.run.states[at(k)].velocity;
  tell_states(system, state);
  state.statics = StaticState{};
  double in_springs = 0.0;
  for (PairRecord& record : state.records) {
    if (system.owns_pair(record.a, record.b))
      for (const PointResponse& response : record.responses) in_springs += response.energy();
    record.work = 0.0;
  }
  for (auto& [blocks, pair] : state.pairs) pair.work = 0.0;
  commit_bolts(state);
  for (std::size_t k = 0; k < state.bolts.size(); ++k)
    if (owns_bolt(system, k)) in_springs += state.bolts[k].stored;
  in_springs += energy_of_ties(system, state, run.caches.contacts);
  state.log.rejections.clear();
  state.steps = 0;
  state.remembers_statics = true;
  state.ledger.clear(in_springs);
  state.ledger.start(system, state.states);
  state.extremes = {};
  state.extremes.penetration = state.report.penetration;
  return status;
}

double energy_of_ties(const BlockSystem& system, RunState& state, StepContacts& contacts) {
  double sum = 0.0;
  // Collective: a process may have no ties of a run that has some.
  if (!any_of_run(system, !system.ties().empty())) return sum;
  for (const ContactPair& pair : contacts.pairs(system, state, {}, PairUse::statics))
    if (pair.tied() && system.owns_pair(pair.a(), pair.b())) sum += pair.start_energy();
  return sum;
}

}  // namespace ashlar
