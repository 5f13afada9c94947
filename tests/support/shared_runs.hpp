// Scenes whose blocks several ranks share, as threads, and the ends of their runs.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "geometry/index.hpp"
#include "solver/ranks/thread_ranks.hpp"
#include "solver/run/checkpoint.hpp"
#include "solver/shared/gathered_run.hpp"
#include "support/simulations.hpp"

namespace ashlar::test_support {

struct Scene {
  std::vector<BlockDefinition> blocks;
  std::vector<InitialMotion> motions;  ///< by block; empty: all are at rest
  JointLaw law;
  SimulationSettings settings;
  std::vector<TieRequest> ties = {};
  std::vector<bool> absent = {};  ///< by block; empty: none
  /// Called with each new simulation, on all ranks: initial stress, overlaps, bolts. Empty: nothing
  std::function<void(Simulation&)> start = {};
};

inline JointLaw spring_joint(double friction) {
  JointLaw law;
  law.normal_stiffness = 1e9;
  law.shear_stiffness = 5e8;
  law.friction = friction;
  return law;
}

/// Running bond on a fixed base, bricks of 0.4 x 0.2 x 0.2 m. Every other course has one less.
inline Scene wall(int courses, int bricks, int order = 1) {
  Scene scene;
  scene.law = spring_joint(0.6);
  scene.settings.time_step = 2e-3;
  scene.settings.contact_distance = 2e-3;
  scene.blocks.push_back(fixed_box({-1, -1, -0.5}, {0.4 * bricks + 1, 1, 0}));
  for (int course = 0; course < courses; ++course) {
    for (int k = 0; k < bricks - course % 2; ++k) {
      const Vector3 low(0.4 * k + (course % 2 == 0 ? 0.0 : 0.2), 0.0, 0.2 * course);
      scene.blocks.push_back(block_of("brick", Polyhedron(make_box(low, low + Vector3(0.4, 0.2, 0.2))),
                                      {2000, 1e9, 0.2}, order));
    }
  }
  scene.motions.resize(scene.blocks.size());
  return scene;
}

/// Turned boxes above a fixed base that fall on each other. @param order of the blocks
/// @param along,above distance of their middles, m: boxes do not overlap from 0.6 and 0.38 m on
inline Scene pile(int layers, int order, double along = 0.45, double above = 0.34) {
  Scene scene;
  scene.law = spring_joint(0.5);
  scene.settings.time_step = 2e-3;
  scene.settings.contact_distance = 2e-3;
  scene.blocks.push_back(fixed_box({-2, -2, -0.5}, {4, 2, 0}));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  for (int layer = 0; layer < layers; ++layer) {
    for (int k = 0; k < 5; ++k) {
      const Vector3 middle(along * k + 0.05 * part(random), 0.05 * part(random), 0.2 + above * layer);
      const Vector3 half(0.2, 0.15, 0.12);
      const Eigen::AngleAxisd turn(0.3 * part(random), Vector3(part(random), 1.0, 0.2).normalized());
      scene.blocks.push_back(
          block_of("stone", turned(Polyhedron(make_box(middle - half, middle + half)), turn, middle),
                   {2500, 1e9, 0.2}, order));
    }
  }
  scene.motions.resize(scene.blocks.size());
  return scene;
}

/// Ranks of blocks by their place along an axis, 0 to 2: as many for each.
inline std::vector<int> owners_along(int axis, const std::vector<BlockDefinition>& blocks, int ranks) {
  std::vector<double> places;
  for (const BlockDefinition& block : blocks) places.push_back(box_of(block.solid->mesh().points).low[axis]);
  std::vector<double> sorted = places;
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> owners;
  for (const double place : places) {
    const auto rank = std::lower_bound(sorted.begin(), sorted.end(), place) - sorted.begin();
    owners.push_back(static_cast<int>(rank * ranks / static_cast<std::ptrdiff_t>(sorted.size())));
  }
  return owners;
}

inline std::vector<int> owners_of(const Scene& scene, int ranks) {
  return owners_along(0, scene.blocks, ranks);
}

/// The end of a run.
struct End {
  std::vector<BlockState> states;
  RunTotals totals;
  std::vector<PairRecord> contacts;
  int steps = 0;
  std::vector<RankWork> work;
  std::vector<Rejection> rejections;
  double largest_step_residual = 0.0;
};

inline bool advance(Simulation& simulation, int steps) {
  while (simulation.steps() < steps)
    if (simulation.step(1e3) != StepStatus::accepted) return false;
  return true;
}

inline End end_of(const Simulation& simulation) {
  return {states_of_run(simulation),         totals_of_run(simulation),
          contacts_of_run(simulation),       simulation.steps(),
          work_of_ranks(simulation),         simulation.rejections(),
          simulation.largest_step_residual()};
}

/// Called on each rank with its blocks before its simulation is made; empty: nothing.
using Preparation = std::function<void(SharedBlocks&)>;

/// Blocks may get other owners. @param steps from one look at the balance to the next
inline Preparation looking_each(int steps, Partition partition = partition_by_place) {
  return [=](SharedBlocks& shared) { shared.balance = {partition, 0.2, steps}; };
}

/// Blocks of all ranks on the first one, or some.
enum class FirstRank {
  has_all_models,  ///< so that it may gather all results
  has_its_own,     ///< and ghosts, as any other
};

inline std::vector<InitialMotion> motions_of(const Scene& scene) {
  return scene.motions.empty() ? std::vector<InitialMotion>(scene.blocks.size()) : scene.motions;
}

inline Simulation simulation_alone(const Scene& scene) {
  std::vector<BlockModel> blocks;
  for (const BlockDefinition& block : scene.blocks) blocks.emplace_back(block);
  Simulation simulation(std::move(blocks), motions_of(scene), same_law(scene.law), scene.settings, scene.ties,
                        scene.absent);
  if (scene.start) scene.start(simulation);
  return simulation;
}

/// The part of one rank. Collective. @param owners by block
inline Simulation simulation_on(Ranks& ranks, const Scene& scene, const std::vector<int>& owners,
                                const Preparation& prepare = {},
                                FirstRank first = FirstRank::has_all_models) {
  const auto load = [all = scene.blocks](int block) { return BlockModel(all[at(block)]); };
  const bool has_all = ranks.own() == 0 && first == FirstRank::has_all_models;
  BlocksOfRank blocks =
      share_blocks(ranks, owners, load, scene.settings, scene.absent, nullptr, has_all, scene.ties);
  if (prepare) prepare(*blocks.shared);
  Simulation simulation(std::move(blocks), motions_of(scene), same_law(scene.law), scene.settings,
                        scene.ties);
  if (scene.start) scene.start(simulation);
  return simulation;
}

/// The value of a program on the first of some ranks. @param program called on each, a thread of its own
template <class Program>
auto on_first_of(int ranks, const Program& program) {
  std::invoke_result_t<const Program&, Ranks&> result{};
  run_on_threads(ranks, [&](Ranks& own) {
    auto here = program(own);
    if (own.own() == 0) result = std::move(here);
  });
  return result;
}

/// The value of a run; of one that has none, the end of its simulation. @param run called with the simulation
template <class Run>
auto end_after(const Run& run, Simulation& simulation) {
  if constexpr (std::is_void_v<std::invoke_result_t<const Run&, Simulation&>>) {
    run(simulation);
    return end_of(simulation);
  } else {
    return run(simulation);
  }
}

inline auto steps_to(int last) {
  return [last](Simulation& simulation) { EXPECT_TRUE(advance(simulation, last)); };
}

/// @return end_after() without ranks
template <class Run>
auto run_alone(const Scene& scene, const Run& run) {
  Simulation simulation = simulation_alone(scene);
  return end_after(run, simulation);
}

inline End run_alone(const Scene& scene, int steps) {
  return run_alone(scene, steps_to(steps));
}

/// @return end_after() of the first rank, which has the models of all blocks. @param run called on each rank
template <class Run>
auto run_shared(const Scene& scene, const std::vector<int>& owners, int ranks, const Run& run,
                const Preparation& prepare = {}) {
  return on_first_of(ranks, [&](Ranks& own) {
    Simulation simulation = simulation_on(own, scene, owners, prepare);
    return end_after(run, simulation);
  });
}

/// No rank has the models of all blocks.
inline End run_shared(const Scene& scene, const std::vector<int>& owners, int ranks, int steps,
                      const Preparation& prepare = {}) {
  return on_first_of(ranks, [&](Ranks& own) {
    Simulation simulation = simulation_on(own, scene, owners, prepare, FirstRank::has_its_own);
    return end_after(steps_to(steps), simulation);
  });
}

/// The snapshot of a run that ranks share, in bytes; empty on all but the first rank. Collective.
inline std::string stored_snapshot(Simulation& simulation) {
  simulation.gather_results();
  const SimulationSnapshot snapshot = simulation.snapshot();
  return simulation.system().exchange().first() ? to_bytes(snapshot) : std::string();
}

/// Largest difference of positions, m.
inline double distance(const End& a, const End& b) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.states.size(); ++k)
    most = std::max(most, (a.states[k].position - b.states[k].position).norm());
  return most;
}

inline bool same_bits(const End& a, const End& b) {
  for (std::size_t k = 0; k < a.states.size(); ++k)
    if (a.states[k].position != b.states[k].position || a.states[k].velocity != b.states[k].velocity)
      return false;
  return a.states.size() == b.states.size() && a.totals.ledger.balance() == b.totals.ledger.balance();
}

}  // namespace ashlar::test_support
