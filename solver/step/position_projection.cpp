#include "solver/step/position_projection.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "geometry/index.hpp"
#include "solver/contact/contact_accounts.hpp"
#include "solver/step/angular_momentum.hpp"
#include "solver/step/applied_force.hpp"
#include "solver/step/block_changes.hpp"

#include "solver/step/velocity_contact.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {
namespace {

constexpr double inertia_share = 0.01;  // of the inertia in a step: blocks move rather than strain

/// An island whose blocks are moved.
struct MovedIsland {
  const Island* island;
  std::size_t place;  // in the funds
  double energy;      // required by its motion, J
  Vector3 momentum;   // angular, before
};

/// Energy that a motion without velocity requires: of elasticity and gravity less the work of loads, J.
double energy_of_motion(const RunContext& run, const Island& island, const std::vector<BodyStep>& bodies) {
  double energy = 0.0;
  for (const int k : island.bodies) {
    const Eigen::MatrixX3d motion = bodies[at(k)].motion();
    const BlockModel& block = run.blocks()[at(k)];
    energy +=
        block.elastic(run.state.states[at(k)].position + motion).energy - run.state.ledger.elastic_energy(k) -
        motion
            .cwiseProduct(block.external_force(run.settings().gravity_at(run.state.time()), run.state.time()))
            .sum();
  }
  return energy;
}

/// The problem of separating blocks: pairs without friction, bodies without motion of their own.
StepProblem pose(const RunContext& run, const std::vector<ContactPair>& pairs) {
  // The same distance is kept for the deformation of springs in this motion.
  const double pushed_from =
      run.settings().multipliers.share * run.settings().multipliers.penetration_tolerance;
  StepProblem problem;
  for (const ContactPair& pair : pairs) problem.pairs.push_back(pair.projected(pushed_from));
  problem.islands = find_islands(run.system.moving(), problem.pairs);
  problem.bodies.resize(run.blocks().size());
  for (int k = 0; k < run.system.count(); ++k) {
    BodyStep& body = problem.bodies[at(k)];
    body.model = &run.blocks()[at(k)];
    body.state = &run.state.states[at(k)];
    body.roundoff_force = run.system.roundoff_force(k);
    body.free_change = body.change = Eigen::VectorXd::Zero(body.model->unknowns());
  }
  return problem;
}

/// Islands with a point that is too deep.
std::vector<const Island*> deep_islands(const RunContext& run, const std::vector<Island>& islands,
                                        const std::vector<ContactPair>& pairs) {
  std::vector<const Island*> deep;
  for (const Island& island : islands) {
    if (std::any_of(island.pairs.begin(), island.pairs.end(), [&](int index) {
          return pairs[at(index)].depth_found() > run.settings().multipliers.tolerated_depth();
        }))
      deep.push_back(&island);
  }
  return deep;
}

/// Lets the blocks of an island start without strain. @param relaxed their states, must outlive the bodies
void relax(const RunContext& run, const Island& island, std::vector<BlockState>& relaxed,
           std::vector<BodyStep>& bodies) {
  for (const int k : island.bodies) {
    BodyStep& body = bodies[at(k)];
    const BlockModel& block = run.blocks()[at(k)];
    relaxed[at(k)] = run.state.states[at(k)];
    // Under stress, blocks of small inertia would turn rather than move.
    if (block.space().can_turn() && block.incremental() == nullptr)
      relaxed[at(k)].position = block.unstrained(run.state.states[at(k)].position);
    body.state = &relaxed[at(k)];
    body.external_force = block.space().restrict(block.elastic(body.state->position).force);
  }
}

/// Computes the motion of each deep island, scaled to its energy account.
std::vector<MovedIsland> solve_deep(const RunContext& run, double step,
                                    const std::vector<const Island*>& deep, StepProblem& problem,
                                    IslandFunds& funds) {
  TimeScheme scheme;
  scheme.kind = StepKind::statics;
  scheme.inertia = inertia_share * 2.0 / (step * step);
  SimulationSettings settings = run.settings();
  settings.statics.residual_tolerance = run.settings().multipliers.apart_residual;
  std::vector<BlockState> relaxed(run.blocks().size());
  std::vector<MovedIsland> moved;
  for (std::size_t n = 0; n < deep.size(); ++n) {
    const Stopwatch watch(run.state.log.seconds.solve);
    const Island& island = *deep[n];
    relax(run, island, relaxed, problem.bodies);
    const IslandResult result =
        solve_island(island, problem.bodies, problem.pairs, scheme, settings, run.factors.islands);
    run.state.log.counts.open_close_iterations += static_cast<std::uint64_t>(result.iterations);
    double energy = energy_of_motion(run, island, problem.bodies);
    const double limit = funds.available(n);
    const bool settled = result.status == IslandStatus::converged;
    const double share = !settled ? 0.0 : energy > limit ? limit / energy : 1.0;
    for (const int k : island.bodies) {
      problem.bodies[at(k)].change *= share;
      problem.bodies[at(k)].follow_rigid(scheme);
    }
    if (share == 0.0) continue;
    if (share < 1.0) energy = energy_of_motion(run, island, problem.bodies);
    funds.use(n, std::min(energy, limit));
    moved.push_back({&island, n, energy, angular_momentum_of(run.blocks(), island.bodies, run.state.states)});
  }
  // Bodies outlive their relaxed states.
  for (std::size_t k = 0; k < relaxed.size(); ++k) problem.bodies[k].state = &run.state.states[k];
  return moved;
}

/// Applies the motion and books it.
void move(const RunContext& run, const std::vector<MovedIsland>& moved, const std::vector<ContactPair>& pairs,
          StepProblem& problem, IslandFunds& funds) {
  LedgerKeeper& ledger = run.state.ledger;
  run.contacts.finder().accept_motion();
  for (int k = 0; k < run.system.count(); ++k) {
    if (!run.system.moving()[at(k)]) continue;
    const Eigen::MatrixX3d motion = problem.bodies[at(k)].motion();
    ledger.loads_did(
        motion.cwiseProduct(applied_force(run.blocks()[at(k)], run.settings(), run.state.time())).sum());
    run.state.states[at(k)].position += motion;
    ledger.measure_elastic(run.system, run.state.states, k);
  }
  for (const auto& [island, place, energy, momentum] : moved) {
    ledger.integrator_took(-energy);

    if (!is_free(run.system, *island, pairs)) continue;
    const Vector3 lost = momentum - angular_momentum_of(run.blocks(), island->bodies, run.state.states);
    const double gain =
        add_spin(run.blocks(), island->bodies, lost, funds.available(place), run.state.states);
    funds.use(place, gain);
    ledger.integrator_took(-gain);
  }
  funds.spend_from(run.state.pairs);
  for (auto& [block, next] : problem.carried)
    start_carried_step(run, static_cast<int>(block), std::move(next));
}

}  // namespace

bool too_deep(const RunContext& run, const std::vector<ContactPair>& pairs) {
  return run.settings().augmented && run.state.has_begun() &&
         std::any_of(pairs.begin(), pairs.end(), [&](const ContactPair& pair) {
           return pair.depth_found() > run.settings().multipliers.tolerated_depth();
         });
}

bool project_positions(const RunContext& run, double step, StepProblem& problem,
                       std::vector<FoundContacts>& found, int additions) {
  StepProblem apart = pose(run, problem.pairs);
  const std::vector<const Island*> deep = deep_islands(run, apart.islands, problem.pairs);
  std::vector<std::vector<PairKey>> contacts;
  contacts.reserve(deep.size());
  for (const Island* island : deep) contacts.push_back(contacts_of(*island, problem.pairs));
  IslandFunds funds(run.state.pairs, std::move(contacts));
  const std::vector<MovedIsland> moved = solve_deep(run, step, deep, apart, funds);
  if (moved.empty()) return false;
  const std::vector<BlockState> after = states_after(run.system, run.state, apart);
  if (const auto passing = run.contacts.check_motion(run.system, run.state, after, found); !passing.empty()) {
    if (additions == 0) return false;
    found = with_passing(std::move(found), passing);
    problem.pairs = run.contacts.pairs(run.system, run.state, found, PairUse::motion);
    return project_positions(run, step, problem, found, additions - 1);
  }
  if (!carry_blocks(run, apart)) return false;
  move(run, moved, problem.pairs, apart, funds);
  return true;
}

}  // namespace ashlar
