#include "solver/step/quiet_release.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/index.hpp"
#include "solver/step/block_changes.hpp"
#include "solver/step/island_equations.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {
namespace {

/// A block whose faces are released.
struct Released {
  int block;
  std::shared_ptr<const BlockParts> held;  ///< with its faces held
  Eigen::MatrixX3d external;               ///< gravity and loads, without waves, (p, 3)
};

/// Equations of rest: forces are those of the present state.
TimeScheme at_rest() {
  TimeScheme scheme;
  scheme.kind = StepKind::statics;
  scheme.inertia = 1.0;
  return scheme;
}

/// Residual forces on the unknowns of released blocks in the present state. @param released increasing blocks
/// @return in their order
std::vector<Eigen::VectorXd> residuals(const RunContext& run, const std::vector<Released>& released) {
  const TimeScheme scheme = at_rest();
  StepProblem problem;
  const std::vector<FoundContacts> found = run.contacts.detect(run.system, run.state, 0.0);
  problem.pairs = run.contacts.pairs(run.system, run.state, found, PairUse::motion);
  pose_step(run.system, run.state, scheme, problem);
  for (const Released& one : released)
    problem.bodies[at(one.block)].external_force = run.blocks()[at(one.block)].space().restrict(one.external);
  std::vector<Eigen::VectorXd> result(released.size());
  for (const Island& island : problem.islands) {
    std::vector<std::pair<std::size_t, int>> there;  // in `released`, and among the bodies
    for (std::size_t n = 0; n < released.size(); ++n) {
      const auto place = std::find(island.bodies.begin(), island.bodies.end(), released[n].block);
      if (place != island.bodies.end())
        there.emplace_back(n, static_cast<int>(place - island.bodies.begin()));
    }
    if (there.empty()) continue;
    IslandSolvers::Entry& solver =
        solver_of(island, problem.bodies, problem.pairs, SystemRole::step, run.factors.islands);
    IslandProblem equations(island, problem.bodies, problem.pairs, scheme, run.settings(), solver);
    equations.respond();
    const Eigen::VectorXd force = equations.residual().force;
    for (const auto& [n, place] : there)
      result[n] = force.segment(solver.matrix.offset(place), run.blocks()[at(released[n].block)].unknowns());
  }
  return result;
}

}  // namespace

void release_quiet_faces(const RunContext& run) {
  std::vector<Released> released;
  BlockPartsLibrary library;
  for (const int k : run.system.quiet()) {
    const BlockModel& block = run.blocks()[at(k)];
    if (!block.holds_quiet_faces()) continue;
    released.push_back({k, block.parts(), external_force(run.system, run.state.clock, k, at_rest())});
    replace_model(run, k, block.with_quiet_faces(true, library));
  }
  if (released.empty()) return;
  const std::vector<Eigen::VectorXd> forces = residuals(run, released);
  for (std::size_t n = 0; n < released.size(); ++n) {
    const BlockModel& block = run.blocks()[at(released[n].block)];
    const AdmissibleSpace& held = released[n].held->space;
    const Eigen::MatrixX3d missing = -block.space().expand(forces[n]);
    run.system.set_reaction(released[n].block, missing - held.expand(held.restrict(missing)));
  }
}

void hold_quiet_faces(const RunContext& run) {
  set_reactions(run, {});
}

void set_reactions(const RunContext& run, const std::map<int, Eigen::MatrixX3d>& reactions) {
  BlockPartsLibrary library;
  for (const int k : run.system.quiet()) {
    const auto reaction = reactions.find(k);
    const bool releases = reaction != reactions.end();
    if (run.blocks()[at(k)].holds_quiet_faces() == releases)
      replace_model(run, k, run.blocks()[at(k)].with_quiet_faces(releases, library));
    if (releases) run.system.set_reaction(k, reaction->second);
  }
}

}  // namespace ashlar
