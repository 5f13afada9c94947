// Scenes whose blocks several ranks share, as threads, and the ends of their runs.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <vector>

#include "geometry/index.hpp"
#include "solver/ranks/thread_ranks.hpp"
#include "solver/run/gathered_run.hpp"
#include "support/simulations.hpp"

namespace ashlar::test_support {

struct Scene {
  std::vector<BlockDefinition> blocks;
  std::vector<InitialMotion> motions;
  JointLaw law;
  SimulationSettings settings;
  std::vector<TieRequest> ties = {};
  bool stressed = false;  ///< starts with the initial stress of its blocks
};

inline JointLaw joint(double friction) {
  JointLaw law;
  law.normal_stiffness = 1e9;
  law.shear_stiffness = 5e8;
  law.friction = friction;
  return law;
}

/// Running bond on a fixed base, bricks of 0.4 x 0.2 x 0.2 m. Every other course has one less.
inline Scene wall(int courses, int bricks, int order = 1) {
  Scene scene;
  scene.law = joint(0.6);
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
  scene.law = joint(0.5);
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

inline End run_alone(const Scene& scene, int steps) {
  std::vector<BlockModel> blocks;
  for (const BlockDefinition& block : scene.blocks) blocks.emplace_back(block);
  Simulation simulation(std::move(blocks), scene.motions, same_law(scene.law), scene.settings, scene.ties);
  if (scene.stressed) simulation.start_stressed();
  EXPECT_TRUE(advance(simulation, steps));
  return end_of(simulation);
}

/// @param prepare called on each rank before its simulation is made; empty: nothing
inline End run_shared(const Scene& scene, const std::vector<int>& owners, int ranks, int steps,
                      const std::function<void(SharedBlocks&)>& prepare = {}) {
  End end;
  run_on_threads(ranks, [&](Ranks& own) {
    const auto load = [&](int block) { return BlockModel(scene.blocks[at(block)]); };
    BlocksOfRank blocks = share_blocks(own, owners, load, scene.settings, {}, nullptr, false, scene.ties);
    if (prepare) prepare(*blocks.shared);
    Simulation simulation(std::move(blocks), scene.motions, same_law(scene.law), scene.settings, scene.ties);
    if (scene.stressed) simulation.start_stressed();
    EXPECT_TRUE(advance(simulation, steps));
    End here = end_of(simulation);
    if (own.own() == 0) end = std::move(here);
  });
  return end;
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
