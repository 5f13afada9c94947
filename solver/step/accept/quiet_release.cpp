#include "solver/step/accept/quiet_release.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/accept/block_changes.hpp"
#include "solver/step/island/island_equations.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {
namespace {

/// A block whose faces are released.
struct Released {
  int block;
  std::shared_ptr<const BlockParts> held;  ///< with its faces held
  Eigen::MatrixX3d external;               ///< gravity and loads of rest, without waves, (p, 3)
};

/// Gravity and loads of the rest that a motion starts from. What is placed without a static analysis or a stress that
/// balances its loads was not at rest under them: they act from the first instant on.
Eigen::MatrixX3d forces_of_rest(const BlockSystem& system, const RunState& state, int block,
                                const TimeScheme& scheme) {
  Eigen::MatrixX3d force = external_force(system, state.clock, block, scheme);
  const BlockModel& model = system.blocks()[at(block)];
  if (!state.remembers_statics && !model.initial_stress()) force -= model.load_force(state.time());
  return force;
}

/// Equations of rest: forces are those of the present state.
TimeScheme at_rest() {
  TimeScheme scheme;
  scheme.kind = StepKind::statics;
  scheme.inertia = 1.0;
  return scheme;
}

/// Residual forces on the unknowns of released blocks in the present state. @param released increasing blocks
/// @return in their order
std::vector<Eigen::VectorXd> residuals(const BlockSystem& system, RunState& state, StepCaches& caches,
                                       const std::vector<Released>& released) {
  const TimeScheme scheme = at_rest();
  StepProblem problem;
  problem.found = caches.contacts.detect(system, state, 0.0);
  problem.pairs = caches.contacts.pairs(system, state, problem.found, PairUse::motion);
  pose_step(system, state, scheme, problem);
  for (const Released& one : released)
    problem.bodies[at(one.block)].external_force =
        system.blocks()[at(one.block)].space().restrict(one.external);
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
        solver_of(island, problem.bodies, problem.pairs, SystemRole::step, caches.factors.islands);
    IslandProblem equations(island, problem.bodies, problem.pairs, scheme, system.settings(), solver);
    equations.respond();
    const Eigen::VectorXd force = equations.residual().force;
    for (const auto& [n, place] : there)
      result[n] =
          force.segment(solver.matrix.offset(place), system.blocks()[at(released[n].block)].unknowns());
  }
  return result;
}

}  // namespace

void release_quiet_faces(BlockSystem& system, RunState& state, StepCaches& caches) {
  std::vector<Released> released;
  BlockPartsLibrary library;
  for (const int k : system.quiet()) {
    const BlockModel& block = system.blocks()[at(k)];
    if (!block.holds_quiet_faces()) continue;
    released.push_back({k, block.parts(), forces_of_rest(system, state, k, at_rest())});
    replace_model(system, state, caches, k, block.with_quiet_faces(true, library));
  }
  if (!any_of_run(system, !released.empty())) return;
  const std::vector<Eigen::VectorXd> forces = residuals(system, state, caches, released);
  for (std::size_t n = 0; n < released.size(); ++n) {
    // Forces on neighbours are not complete.
    if (!system.owns(released[n].block)) continue;
    const BlockModel& block = system.blocks()[at(released[n].block)];
    const AdmissibleSpace& held = released[n].held->space;
    const Eigen::MatrixX3d missing = -block.space().expand(forces[n]);
    system.set_reaction(released[n].block, missing - held.expand(held.restrict(missing)));
  }
  system.exchange().tell_models(system, state, caches);
}

void hold_quiet_faces(BlockSystem& system, RunState& state, StepCaches& caches) {
  set_reactions(system, state, caches, {});
}

void set_reactions(BlockSystem& system, RunState& state, StepCaches& caches,
                   const std::map<int, Eigen::MatrixX3d>& reactions) {
  BlockPartsLibrary library;
  for (const int k : system.quiet()) {
    const auto reaction = reactions.find(k);
    set_reaction_of(system, state, caches, k,
                    reaction == reactions.end() ? Eigen::MatrixX3d() : reaction->second, library);
  }
}

Eigen::MatrixX3d released_reaction(const BlockModel& block) {
  return block.quiet() && !block.holds_quiet_faces() ? block.reaction() : Eigen::MatrixX3d();
}

void set_reaction_of(BlockSystem& system, RunState& state, StepCaches& caches, int block,
                     const Eigen::MatrixX3d& reaction, BlockPartsLibrary& library) {
  const BlockModel& model = system.blocks()[at(block)];
  const bool releases = reaction.rows() > 0;
  if (model.holds_quiet_faces() == releases)
    replace_model(system, state, caches, block, model.with_quiet_faces(releases, library));
  if (releases) system.set_reaction(block, reaction);
}

}  // namespace ashlar
