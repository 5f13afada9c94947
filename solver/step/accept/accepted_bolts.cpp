#include "solver/step/accept/accepted_bolts.hpp"

#include <optional>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/island/bolts_of_run.hpp"

namespace ashlar {
namespace {

/// Breaks bars at their rupture strain. @return energy released, J; empty: none broke
std::optional<double> rupture(const Bolt& bolt, BoltState& state, const Eigen::VectorXd& deformation,
                              const BoltResponse& response) {
  if (!bolt.chain.rupture(deformation, response, state.reached)) return std::nullopt;
  const double before = state.stored;
  state.memory = state.reached;
  take_forces(bolt.chain.respond(deformation, state.memory, false), state);
  state.dissipated = 0.0;
  return before - state.stored;
}

}  // namespace

BoltEnergies take_over_bolts(const BlockSystem& system, RunState& state, const StepProblem& problem) {
  BoltEnergies sum, elsewhere;
  const bool is_static = problem.scheme.is_static();
  LedgerKeeper& ledger = state.ledger;
  double found = 0.0;
  for (std::size_t i = 0; i < problem.islands.size(); ++i) {
    const IslandResult& result = problem.results[i];
    for (std::size_t n = 0; n < result.bolts.size(); ++n) {
      const BoltResult& one = result.bolts[n];
      const StepBolt& bolt = *problem.islands[i].bolts[n];
      BoltState& kept = state.bolts[at(bolt.index())];
      const bool owned = owns_bolt(system, at(bolt.index()));
      BoltEnergies& booked = owned ? sum : elsewhere;
      if (owned) found += bolt.start_energy() - kept.stored;
      const double dissipated_before = is_static ? kept.dissipated : 0.0;
      kept.reached = bolt.bolt().chain.memory_after(one.response.end, bolt.memory());
      take_forces(one.response.end, kept);
      booked.work += one.work;
      booked.dissipated += kept.dissipated - dissipated_before;
      booked.gained += kept.stored - bolt.start_energy();
      if (owned) ledger.loads_did(-one.prescribed_work);
      if (!is_static) {
        kept.memory = kept.reached;
        kept.dissipated = 0.0;
        if (const auto released =
                rupture(system.bolts()[at(bolt.index())], kept, one.response.deformation, one.response.end)) {
          booked.gained -= *released;
          booked.dissipated += *released;
        }
      }
      booked.held += kept.stored;
    }
  }
  if (found != 0.0) ledger.found_anew(found);
  return sum;
}

void commit_bolts(RunState& state) {
  for (BoltState& bolt : state.bolts) {
    bolt.memory = bolt.reached;
    bolt.dissipated = 0.0;
  }
}

bool rupture_bolts(const BlockSystem& system, RunState& state) {
  bool any = false;
  for (std::size_t k = 0; k < state.bolts.size(); ++k) {
    BoltState& one = state.bolts[k];
    const Bolt& bolt = system.bolts()[k];
    if (!one.installed() || bolt.chain.law().rupture_strain == BoltLaw::unlimited) continue;
    if (!knows_bolt(system, k)) continue;
    const Eigen::VectorXd deformation = deformation_in(bolt, system.blocks(), state.states);
    const BoltResponse response = bolt.chain.respond(deformation, one.memory, false);
    const std::optional<double> released = rupture(bolt, one, deformation, response);
    if (!released) continue;
    any = true;
    if (!owns_bolt(system, k)) continue;
    state.ledger.sliding_took(*released);
    state.ledger.springs_hold(state.ledger.ledger().contact - *released);
  }
  return any_of_run(system, any);
}

double install_bolts(const BlockSystem& system, RunState& state) {
  state.bolts.resize(system.bolts().size());
  for (std::size_t k = 0; k < system.bolts().size(); ++k) {
    const Bolt& bolt = system.bolts()[k];
    BoltState& one = state.bolts[k];
    if (!bolt.installed) {
      one = BoltState{};
      continue;
    }
    if (!one.installed() && knows_bolt(system, k)) {
      const Eigen::VectorXd deformation = deformation_in(bolt, system.blocks(), state.states);
      one.memory = one.reached = bolt.chain.installed_at(deformation);
      take_forces(bolt.chain.respond(deformation, one.memory, false), one);
    }
  }
  tell_bolts(system, state);
  double stored = 0.0;
  for (std::size_t k = 0; k < state.bolts.size(); ++k)
    if (owns_bolt(system, k)) stored += state.bolts[k].stored;
  return stored;
}

}  // namespace ashlar
