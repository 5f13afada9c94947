#include "solver/step/accepted_bolts.hpp"

#include <optional>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Breaks bars at their rupture strain. @return energy released, J; empty: none broke
std::optional<double> rupture(const RunContext& run, int index, const Eigen::VectorXd& deformation,
                              const BoltResponse& response) {
  const Bolt& bolt = run.system.bolts()[at(index)];
  BoltState& state = run.state.bolts[at(index)];
  if (!bolt.chain.rupture(deformation, response, state.reached)) return std::nullopt;
  const double before = state.stored;
  state.memory = state.reached;
  take_forces(bolt.chain.respond(deformation, state.memory, false), state);
  state.dissipated = 0.0;
  return before - state.stored;
}

}  // namespace

BoltEnergies take_over_bolts(const RunContext& run, const TimeScheme& scheme, const StepProblem& problem) {
  BoltEnergies sum;
  LedgerKeeper& ledger = run.state.ledger;
  double found = 0.0;
  for (std::size_t i = 0; i < problem.islands.size(); ++i) {
    const IslandResult& result = problem.results[i];
    for (std::size_t n = 0; n < result.bolts.size(); ++n) {
      const BoltResult& one = result.bolts[n];
      const StepBolt& bolt = *problem.islands[i].bolts[n];
      BoltState& state = run.state.bolts[at(bolt.index())];
      found += bolt.start_energy() - state.stored;
      const double dissipated_before = scheme.is_static() ? state.dissipated : 0.0;
      state.reached = bolt.bolt().chain.memory_after(one.response.end, bolt.memory());
      take_forces(one.response.end, state);
      sum.work += one.work;
      sum.dissipated += state.dissipated - dissipated_before;
      sum.gained += state.stored - bolt.start_energy();
      ledger.loads_did(-one.prescribed_work);
      if (!scheme.is_static()) {
        state.memory = state.reached;
        state.dissipated = 0.0;
        if (const auto released = rupture(run, bolt.index(), one.response.deformation, one.response.end)) {
          sum.gained -= *released;
          sum.dissipated += *released;
        }
      }
      sum.held += state.stored;
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

bool rupture_bolts(const RunContext& run) {
  bool any = false;
  for (std::size_t k = 0; k < run.state.bolts.size(); ++k) {
    BoltState& state = run.state.bolts[k];
    const Bolt& bolt = run.system.bolts()[k];
    if (!state.installed() || bolt.chain.law().rupture_strain == BoltLaw::unlimited) continue;
    const Eigen::VectorXd deformation = deformation_in(bolt, run.blocks(), run.state.states);
    const BoltResponse response = bolt.chain.respond(deformation, state.memory, false);
    const std::optional<double> released = rupture(run, static_cast<int>(k), deformation, response);
    if (!released) continue;
    any = true;
    run.state.ledger.sliding_took(*released);
    run.state.ledger.springs_hold(run.state.ledger.ledger().contact - *released);
  }
  return any;
}

double install_bolts(const BlockSystem& system, RunState& state) {
  double stored = 0.0;
  state.bolts.resize(system.bolts().size());
  for (std::size_t k = 0; k < system.bolts().size(); ++k) {
    const Bolt& bolt = system.bolts()[k];
    BoltState& one = state.bolts[k];
    if (!bolt.installed) {
      one = BoltState{};
      continue;
    }
    if (!one.installed()) {
      const Eigen::VectorXd deformation = deformation_in(bolt, system.blocks(), state.states);
      one.memory = one.reached = bolt.chain.installed_at(deformation);
      take_forces(bolt.chain.respond(deformation, one.memory, false), one);
    }
    stored += one.stored;
  }
  return stored;
}

}  // namespace ashlar
