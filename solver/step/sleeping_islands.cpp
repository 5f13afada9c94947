#include "solver/step/sleeping_islands.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Wakes islands that satisfy a condition: their blocks start from rest and have to come to rest again.
template <class Condition>
bool wake_if(const RunContext& run, const Condition& wakes) {
  std::vector<SleepingIsland>& islands = run.state.sleep.islands;
  std::vector<SleepingIsland> still;
  for (SleepingIsland& island : islands) {
    if (!wakes(island)) {
      still.push_back(std::move(island));
      continue;
    }
    for (const int block : island.blocks) run.state.sleep.rests[at(block)] = BlockRest{};
  }
  const bool any = still.size() != islands.size();
  islands = std::move(still);
  if (any) hold_sleepers(run.system, run.state.sleep);
  return any;
}

/// Motion of a step without its alternating part: the mean with the step before.
Eigen::MatrixX3d steady_part(const Eigen::MatrixX3d& motion, const BlockRest& rest) {
  return rest.motion.size() > 0 ? Eigen::MatrixX3d(0.5 * (motion + rest.motion)) : motion;
}

/// True if vibrations that the step does not resolve decay.
bool dissipates(const SimulationSettings& settings) {
  return settings.integrator == Integrator::dda ||
         (settings.integrator == Integrator::generalized_alpha && settings.spectral_radius < 1.0);
}

/// Mean residual force on a block in the window, as a share of the largest force on it.
double unbalanced_share(const Sleep& sleep, const BodyStep& body, const BlockRest& rest,
                        const Eigen::MatrixX3d& velocity) {
  const double gained = (velocity - rest.velocity).norm();
  return gained > 0.0 ? body.model->material().density * gained / sleep.window_time / body.largest_force
                      : 0.0;
}

/// @param velocities of the blocks' steady parts
bool rests(const RunContext& run, const StepProblem& problem, const Island& island,
           const std::vector<Eigen::MatrixX3d>& velocities) {
  const RestSettings& settings = run.settings().rest;
  const double way = settings.way_share * run.settings().contact_distance;
  return std::all_of(island.bodies.begin(), island.bodies.end(), [&](int block) {
    const BlockRest& rest = run.state.sleep.rests[at(block)];
    return rest.last_path + rest.path + run.contacts.finder().checked_motion(block) <= way &&
           rest.path <= settings.fading * rest.last_path &&
           unbalanced_share(run.state.sleep, problem.bodies[at(block)], rest, velocities[at(block)]) <=
               settings.unbalanced_share;
  });
}

void put_to_sleep(const RunContext& run, const StepProblem& problem, std::size_t island) {
  SleepingIsland sleeping{problem.islands[island].bodies, 0.0};
  for (const PairResponse& response : problem.results[island].responses)
    sleeping.held += ContactPair::energies(response).total();
  for (const BoltResult& bolt : problem.results[island].bolts) sleeping.held += bolt.response.end.stored;
  for (const int block : sleeping.blocks) {
    BlockState& state = run.state.states[at(block)];
    run.state.ledger.integrator_took(run.blocks()[at(block)].kinetic_energy(state));
    state.velocity.setZero();
    if (!run.state.accelerations.empty()) run.state.accelerations[at(block)].setZero();
  }
  run.state.sleep.islands.push_back(std::move(sleeping));
  ++run.state.log.counts.islands_put_to_sleep;
}

}  // namespace

void hold_sleepers(BlockSystem& system, const Sleep& sleep) {
  system.let_go();
  for (const SleepingIsland& island : sleep.islands) system.hold(island.blocks);
}

void wake_for_loads(const RunContext& run, double step) {
  if (run.state.sleep.islands.empty()) return;
  const double start = run.state.time();
  const double end = run.state.clock.time_after(step);
  const GravityHistory& gravity = run.settings().gravity_history;
  const bool all = !gravity.empty() && gravity.changes_between(start, end);
  wake_if(run, [&](const SleepingIsland& island) {
    return all || std::any_of(island.blocks.begin(), island.blocks.end(), [&](int block) {
             return run.blocks()[at(block)].loads_change_between(start, end);
           });
  });
}

bool wake_touched(const RunContext& run, const std::vector<ContactPair>& pairs) {
  if (run.state.sleep.islands.empty()) return false;
  std::set<int> touched;
  const std::vector<bool>& moving = run.system.moving();
  for (const ContactPair& pair : pairs) {
    if (moving[at(pair.a())] != moving[at(pair.b())])
      touched.insert(moving[at(pair.a())] ? pair.b() : pair.a());
  }
  return wake_if(run, [&](const SleepingIsland& island) {
    return std::any_of(island.blocks.begin(), island.blocks.end(),
                       [&](int block) { return touched.count(block) > 0; });
  });
}

void wake_all(const RunContext& run) {
  wake_if(run, [](const SleepingIsland&) { return true; });
}

void note_rest(const RunContext& run, const TimeScheme& scheme, const StepProblem& problem) {
  const RestSettings& settings = run.settings().rest;
  Sleep& sleep = run.state.sleep;
  if (!settings.sleeps || scheme.is_static() || !dissipates(run.settings())) return;
  run.state.log.counts.sleeping_block_steps += static_cast<std::uint64_t>(sleep.sleeping_blocks());
  std::vector<Eigen::MatrixX3d> velocities(run.blocks().size());
  for (const Island& island : problem.islands) {
    for (const int block : island.bodies) {
      BlockRest& rest = sleep.rests[at(block)];
      Eigen::MatrixX3d motion = problem.bodies[at(block)].motion();
      const Eigen::MatrixX3d steady = steady_part(motion, rest);
      rest.path += run.contacts.finder().motion_bound(block, steady);
      rest.motion = std::move(motion);
      velocities[at(block)] = steady / scheme.step;
    }
  }
  sleep.window_time += scheme.step;
  if (++sleep.window_steps < settings.window) return;
  for (std::size_t k = 0; k < problem.islands.size(); ++k)
    if (rests(run, problem, problem.islands[k], velocities)) put_to_sleep(run, problem, k);
  for (const Island& island : problem.islands) {
    for (const int block : island.bodies) {
      BlockRest& rest = sleep.rests[at(block)];
      rest.last_path = std::exchange(rest.path, 0.0);
      rest.velocity = std::move(velocities[at(block)]);
    }
  }
  sleep.window_steps = 0;
  sleep.window_time = 0.0;
  hold_sleepers(run.system, sleep);
}

}  // namespace ashlar
