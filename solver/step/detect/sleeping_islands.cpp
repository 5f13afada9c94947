#include "solver/step/detect/sleeping_islands.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/island/bolts_of_run.hpp"

namespace ashlar {
namespace {

/// Wakes islands that satisfy a condition: their blocks start from rest and have to come to rest again.
template <class Condition>
bool wake_if(BlockSystem& system, RunState& state, const Condition& wakes) {
  std::vector<SleepingIsland>& islands = state.sleep.islands;
  std::vector<SleepingIsland> still;
  std::vector<bool> woken;
  for (const SleepingIsland& island : islands) woken.push_back(wakes(island));
  woken = any_of_run(system, woken);
  std::size_t next = 0;
  for (SleepingIsland& island : islands) {
    if (!woken[next++]) {
      still.push_back(std::move(island));
      continue;
    }
    for (const int block : island.blocks) state.sleep.rests[at(block)] = BlockRest{};
  }
  const bool any = still.size() != islands.size();
  islands = std::move(still);
  if (any) hold_sleepers(system, state.sleep);
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

/// True if a block hardly moves any more. @param checked upper bound of its path in the last step, m
bool fades(const SimulationSettings& settings, const BlockRest& rest, double checked) {
  return rest.last_path + rest.path + checked <= settings.rest.path_share * settings.contact_distance &&
         rest.path <= settings.rest.fading * rest.last_path;
}

/// Adds a step to the paths of blocks. @return by block, velocities of their steady parts
std::vector<Eigen::MatrixX3d> note_paths(const BlockSystem& system, const ContactFinder& finder,
                                         const StepProblem& problem, Sleep& sleep) {
  std::vector<Eigen::MatrixX3d> velocities(problem.bodies.size());
  for (const Island& island : problem.islands) {
    for (const int block : island.bodies) {
      if (!system.owns(block)) continue;
      BlockRest& rest = sleep.rests[at(block)];
      Eigen::MatrixX3d motion = problem.bodies[at(block)].motion();
      const Eigen::MatrixX3d steady = steady_part(motion, rest);
      rest.path += finder.motion_bound(block, steady);
      rest.motion = std::move(motion);
      velocities[at(block)] = steady / problem.scheme.step;
    }
  }
  return velocities;
}

/// The part of an island that a process owns.
struct RestingPart {
  int first = -1;           ///< lowest block of the whole island
  std::vector<int> blocks;  ///< increasing
  double held = 0.0;        ///< energy of springs of its pairs, J
  bool rests = true;        ///< all blocks do
};

/// Parts of all islands, by their first blocks. @param rests (block) -> bool, of own blocks
template <class Rests>
std::map<int, RestingPart> parts_of(const BlockSystem& system, const StepProblem& problem,
                                    const Rests& rests) {
  std::map<int, RestingPart> parts;
  for (std::size_t k = 0; k < problem.islands.size(); ++k) {
    const Island& island = problem.islands[k];
    const bool shared = static_cast<int>(k) == problem.shared;
    std::map<int, int> first;  // of a body's island
    if (shared) first = system.exchange().first_blocks(system, island, problem.pairs);
    const auto part_of = [&](int block) -> RestingPart& {
      return parts[shared ? first.at(block) : island.bodies.front()];
    };
    for (const int block : island.bodies) {
      RestingPart& part = part_of(block);
      part.first = shared ? first.at(block) : island.bodies.front();
      if (!system.owns(block)) continue;
      part.blocks.push_back(block);
      part.rests = part.rests && rests(block);
    }
    for (std::size_t n = 0; n < island.pairs.size(); ++n) {
      const ContactPair& pair = problem.pairs[at(island.pairs[n])];
      if (!system.owns_pair(pair.a(), pair.b())) continue;
      part_of(system.moving()[at(pair.a())] ? pair.a() : pair.b()).held +=
          ContactPair::energies(problem.results[k].responses[n]).total();
    }
    for (std::size_t n = 0; n < island.bolts.size(); ++n) {
      const StepBolt& bolt = *island.bolts[n];
      if (owns_bolt(system, at(bolt.index())))
        part_of(moving_block(system, bolt)).held += problem.results[k].bolts[n].response.end.stored;
    }
  }
  return parts;
}

/// Islands whose blocks all rest, with their blocks on all processes and the energy held here, in order.
template <class Rests>
std::vector<RestingPart> resting_islands(const BlockSystem& system, const StepProblem& problem,
                                         const Rests& rests) {
  const std::map<int, RestingPart> own = parts_of(system, problem, rests);
  std::map<int, RestingPart> parts = own;
  if (!system.exchange().alone()) {
    for (auto& [first, part] : parts) part.blocks.clear();
    for (const auto& of_process : values_of_run(system, own)) {
      for (const auto& [first, other] : of_process) {
        RestingPart& part = parts[first];
        part.first = first;
        part.blocks.insert(part.blocks.end(), other.blocks.begin(), other.blocks.end());
        part.rests = part.rests && other.rests;
      }
    }
  }
  std::vector<RestingPart> resting;
  for (auto& [first, part] : parts) {
    if (!part.rests) continue;
    std::sort(part.blocks.begin(), part.blocks.end());
    resting.push_back(std::move(part));
  }
  return resting;
}

void put_to_sleep(const BlockSystem& system, RunState& state, RestingPart&& island) {
  for (const int block : island.blocks) {
    BlockState& still = state.states[at(block)];
    if (system.owns(block)) state.ledger.integrator_took(system.blocks()[at(block)].kinetic_energy(still));
    still.velocity.setZero();
    if (!state.accelerations.empty()) state.accelerations[at(block)].setZero();
  }
  state.sleep.islands.push_back({std::move(island.blocks), island.held});
  ++state.log.counts.islands_put_to_sleep;
}

}  // namespace

void hold_sleepers(BlockSystem& system, const Sleep& sleep) {
  system.let_go();
  for (const SleepingIsland& island : sleep.islands) system.hold(island.blocks);
}

void wake_for_loads(BlockSystem& system, RunState& state, double step) {
  if (state.sleep.islands.empty()) return;
  const double start = state.time();
  const double end = state.clock.time_after(step);
  const GravityHistory& gravity = system.settings().gravity_history;
  const bool all = !gravity.empty() && gravity.changes_between(start, end);
  wake_if(system, state, [&](const SleepingIsland& island) {
    return all || std::any_of(island.blocks.begin(), island.blocks.end(), [&](int block) {
             return system.blocks()[at(block)].loads_change_between(start, end);
           });
  });
}

bool wake_touched(BlockSystem& system, RunState& state, const std::vector<ContactPair>& pairs) {
  if (state.sleep.islands.empty()) return false;
  std::set<int> touched;
  const std::vector<bool>& moving = system.moving();
  for (const ContactPair& pair : pairs) {
    if (moving[at(pair.a())] != moving[at(pair.b())])
      touched.insert(moving[at(pair.a())] ? pair.b() : pair.a());
  }
  return wake_if(system, state, [&](const SleepingIsland& island) {
    return std::any_of(island.blocks.begin(), island.blocks.end(),
                       [&](int block) { return touched.count(block) > 0; });
  });
}

void wake_all(BlockSystem& system, RunState& state) {
  wake_if(system, state, [](const SleepingIsland&) { return true; });
}

void note_rest(BlockSystem& system, RunState& state, const ContactFinder& finder,
               const StepProblem& problem) {
  const RestSettings& settings = system.settings().rest;
  Sleep& sleep = state.sleep;
  if (!settings.sleeps || problem.scheme.is_static() || !dissipates(system.settings())) return;
  for (const SleepingIsland& island : sleep.islands)
    for (const int block : island.blocks) state.log.counts.sleeping_block_steps += system.owns(block) ? 1 : 0;
  std::vector<Eigen::MatrixX3d> velocities = note_paths(system, finder, problem, sleep);
  sleep.window_time += problem.scheme.step;
  if (++sleep.window_steps < settings.window) return;
  const auto rests = [&](int block) {
    const BlockRest& rest = sleep.rests[at(block)];
    return fades(system.settings(), rest, finder.checked_motion(block)) &&
           unbalanced_share(sleep, problem.bodies[at(block)], rest, velocities[at(block)]) <=
               settings.unbalanced_share;
  };
  for (RestingPart& island : resting_islands(system, problem, rests))
    put_to_sleep(system, state, std::move(island));
  for (const Island& island : problem.islands) {
    for (const int block : island.bodies) {
      if (!system.owns(block)) continue;
      BlockRest& rest = sleep.rests[at(block)];
      rest.last_path = std::exchange(rest.path, 0.0);
      rest.velocity = std::move(velocities[at(block)]);
    }
  }
  sleep.window_steps = 0;
  sleep.window_time = 0.0;
  hold_sleepers(system, sleep);
}

}  // namespace ashlar
