#include "solver/step/step_problem.hpp"

#include <optional>
#include <utility>

#include "geometry/index.hpp"
#include "solver/parallel_for.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/island/bolts_of_run.hpp"
#include "solver/step/solve/joined_island.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {
namespace {

std::vector<BodyStep> prepare_bodies(const BlockSystem& system, const RunState& state,
                                     const TimeScheme& scheme) {
  std::vector<BodyStep> bodies(system.blocks().size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const BlockModel& block = system.blocks()[k];
    BodyStep& body = bodies[k];
    body.model = &block;
    body.state = &state.states[k];
    body.roundoff_force = system.roundoff_force(static_cast<int>(k));
    if (block.fixed()) continue;
    body.change = Eigen::VectorXd::Zero(block.unknowns());
    if (!system.moving()[k]) continue;
    if (scheme.stiffness_share > 0.0) {
      body.note_start_force();
      // internal_force(): elasticity at the end once and k times, at the start k times.
      body.roundoff_force *= 1.0 + 2.0 * scheme.stiffness_share;
    }
    const Eigen::MatrixX3d still = Eigen::MatrixX3d::Zero(block.basis().size(), 3);
    const Eigen::MatrixX3d& acceleration = state.accelerations.empty() ? still : state.accelerations[k];
    body.free_change =
        block.space().restrict(scheme.free_change(still, state.states[k].velocity, acceleration));
    if (block.dashpots() != nullptr && !scheme.is_static()) {
      body.dashpots = block.dashpots();
      body.carried_velocity =
          block.space().restrict(scheme.dashpot_velocity(still, state.states[k].velocity, acceleration));
    }
    body.external_force =
        block.space().restrict(external_force(system, state.clock, static_cast<int>(k), scheme));
    body.prescribed =
        block.prescribed_change(state.states[k].position, state.time(), state.clock.time_after(scheme.step));
  }
  return bodies;
}

/// Solves all islands even if one does not converge: the work does not depend on the number of threads.
std::vector<IslandResult> solve_islands(StepProblem& problem, const TimeScheme& scheme,
                                        const SimulationSettings& settings, FactorCache& factors) {
  std::vector<IslandResult> results(problem.islands.size());
  std::vector<std::pair<std::size_t, IslandSolvers::Entry*>> left;
  for (std::size_t k = 0; k < results.size(); ++k) {
    const Island& island = problem.islands[k];
    if (static_cast<int>(k) == problem.shared) continue;
    std::optional<IslandResult> lone;
    if (island.bodies.size() == 1 && island.pairs.empty() && island.bolts.empty())
      lone = solve_lone_body(problem.bodies[at(island.bodies[0])], scheme, settings, factors.lone);
    if (lone) {
      results[k] = std::move(*lone);
    } else {
      left.emplace_back(k,
                        &solver_of(island, problem.bodies, problem.pairs, SystemRole::step, factors.islands));
    }
  }
  parallel_for(settings.threads, left.size(), [&](std::size_t n) {
    const auto& [k, solver] = left[n];
    results[k] = solve_island(problem.islands[k], problem.bodies, problem.pairs, scheme, settings, *solver);
  });
  return results;
}

}  // namespace

IslandStatus solve(const BlockSystem& system, RunState& state, const TimeScheme& scheme, FactorCache& factors,
                   StepProblem& problem) {
  const Stopwatch watch(state.log.seconds.solve);
  const auto swap_followed = [&](IslandResult& result) {
    for (auto& [index, pair] : result.followed) std::swap(problem.pairs[at(index)], pair);
  };
  // From the last trial.
  for (IslandResult& result : problem.results) swap_followed(result);
  problem.results.clear();
  pose_step(system, state, scheme, problem);
  problem.results = solve_islands(problem, scheme, system.settings(), factors);
  if (problem.shared >= 0)
    problem.results[at(problem.shared)] =
        solve_joined_island(system, problem.islands[at(problem.shared)], problem.bodies, problem.pairs,
                            scheme, system.settings(), &factors.shared);
  SimulationCounts& counts = state.log.counts;
  IslandStatus status = IslandStatus::converged;
  for (IslandResult& result : problem.results) {
    swap_followed(result);
    counts.open_close_iterations += static_cast<std::uint64_t>(result.iterations);
    counts.open_close_fallbacks += static_cast<std::uint64_t>(result.fallbacks);
    if (status == IslandStatus::converged) status = result.status;
  }
  tell_changes(system, problem.bodies);
  return static_cast<IslandStatus>(most_of_run(system, static_cast<double>(status)));
}

void pose_step(const BlockSystem& system, const RunState& state, const TimeScheme& scheme,
               StepProblem& problem) {
  problem.scheme = scheme;
  problem.bolts = bolts_of_step(system, state);
  problem.islands = find_islands(system.moving(), problem.pairs, problem.bolts);
  validate(problem.islands, system.moving(), problem.pairs);
  problem.shared = system.exchange().join_islands(system, problem.islands);
  problem.bodies = prepare_bodies(system, state, scheme);
  for (ContactPair& pair : problem.pairs) {
    pair.begin_step(system.blocks()[at(pair.a())], system.blocks()[at(pair.b())],
                    {problem.bodies[at(pair.a())].prescribed, problem.bodies[at(pair.b())].prescribed,
                     scheme.is_static() ? 0.0 : scheme.step, system.settings().augmented});
  }
  for (StepBolt& bolt : problem.bolts)
    bolt.prescribe([&](int block) { return problem.bodies[at(block)].prescribed; });
}

Eigen::MatrixX3d external_force(const BlockSystem& system, const StepClock& clock, int block,
                                const TimeScheme& scheme) {
  const auto force = [&](double when) {
    return system.blocks()[at(block)].external_force(system.settings().gravity_at(when), when);
  };
  return scheme.smooth_force(force, clock.time(), clock.time_after(scheme.step));
}

std::vector<BlockState> driven_states(const BlockSystem& system, const RunState& state, double step) {
  std::vector<BlockState> states;
  for (std::size_t k = 0; k < system.blocks().size(); ++k) {
    const BlockModel& block = system.blocks()[k];
    const Eigen::MatrixX3d prescribed =
        block.prescribed_change(state.states[k].position, state.time(), state.clock.time_after(step));
    if (prescribed.isZero(0.0)) continue;  // a zero displacement needs no velocity
    if (states.empty()) states = state.states;
    states[k].velocity = block.space().expand(block.space().restrict(state.states[k].velocity)) +
                         prescribed / (step > 0.0 ? step : 1.0);
  }
  return states;
}

std::vector<Eigen::MatrixX3d> smooth_accelerations(const BlockSystem& system, const RunState& state) {
  std::vector<Eigen::MatrixX3d> result;
  for (std::size_t k = 0; k < system.blocks().size(); ++k) {
    const BlockModel& block = system.blocks()[k];
    result.emplace_back(Eigen::MatrixX3d::Zero(block.basis().size(), 3));
    if (!system.moving()[k]) continue;
    const Eigen::MatrixX3d force =
        block.external_force(system.settings().gravity_at(state.time()), state.time()) -
        block.elastic(state.states[k].position).force;
    Eigen::VectorXd smooth = block.space().restrict(force);
    if (block.dashpots() != nullptr)
      smooth -= *block.dashpots() * block.space().restrict(state.states[k].velocity);
    result.back() = block.space().expand(smooth) / block.material().density -
                    system.settings().mass_damping * state.states[k].velocity;
  }
  return result;
}

std::vector<BlockState> states_after(const BlockSystem& system, const RunState& state,
                                     const StepProblem& problem) {
  std::vector<BlockState> after = state.states;
  for (std::size_t k = 0; k < after.size(); ++k) {
    if (system.moving()[k]) after[k].position += problem.bodies[k].motion();
  }
  return after;
}

}  // namespace ashlar
