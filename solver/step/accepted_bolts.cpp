#include "solver/step/accepted_bolts.hpp"

#include <optional>

#include "geometry/index.hpp"

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
  BoltEnergies sum;
  const bool is_static = problem.scheme.is_static();
  LedgerKeeper& ledger = state.ledger;
  double found = 0.0;
  for (std::size_t i = 0; i < problem.islands.size(); ++i) {
    const IslandResult& result = problem.results[i];
    for (std::size_t n = 0; n < result.bolts.size(); ++n) {
      const BoltResult& one = result.bolts[n];
      const StepBolt& bolt = *problem.islands[i].bolts[n];
      BoltState& kept = state.bolts[at(bolt.index())];
      found += bolt.start_energy() - kept.stored;
      const double dissipated_before = is_static ? kept.dissipated : 0.0;
      kept.reached = bolt.bolt().chain.memory_after(one.response.end, bolt.memory());
      take_forces(one.response.end, kept);
      sum.work += one.work;
      sum.dissipated += kept.dissipated - dissipated_before;
      sum.gained += kept.stored - bolt.start_energy();
      ledger.loads_did(-one.prescribed_work);
      if (!is_static) {
        kept.memory = kept.reached;
        kept.dissipated = 0.0;
        if (const auto released =
                rupture(system.bolts()[at(bolt.index())], kept, one.response.deformation, one.response.end)) {
          sum.gained -= *released;
          sum.dissipated += *released;
        }
      }
      sum.held += kept.stored;
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
    const Eigen::VectorXd deformation = deformation_in(bolt, system.blocks(), state.states);
    const BoltResponse response = bolt.chain.respond(deformation, one.memory, false);
    const std::optional<double> released = rupture(bolt, one, deformation, response);
    if (!released) continue;
    any = true;
    state.ledger.sliding_took(*released);
    state.ledger.springs_hold(state.ledger.ledger().contact - *released);
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
