// Quiet faces of blocks that several ranks share: the reaction of rest, waves as on one rank, checkpoints.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "solver/run/checkpoint.hpp"
#include "support/shared_runs.hpp"

namespace ashlar::shared_quiet_boundaries_test {
namespace {

using test_support::advance;
using test_support::block_of;
using test_support::End;
using test_support::end_of;
using test_support::joint;
using test_support::run_static;
using test_support::same_law;
using test_support::Scene;

/// lambda = mu = 8e7 Pa.
const Material soil{2000.0, 2e8, 0.25};

/// Two columns of two blocks beside each other, on a quiet base with a wave across. Blocks 0 and 1 are at the base.
Scene ground(Integrator integrator) {
  Scene scene;
  scene.law = joint(0.6);
  scene.law.rigid = true;
  scene.settings.time_step = 1e-3;
  scene.settings.contact_distance = 2e-3;
  scene.settings.integrator = integrator;
  scene.settings.gravity = {0, 0, -10};
  WaveVelocity wave;
  wave[0] = {{0.0, 0.02, 0.04}, {0.0, 0.1, 0.0}};
  for (const double z : {0.0, 4.0}) {
    for (const double x : {0.0, 3.0}) {
      BlockDefinition block = block_of("soil", Polyhedron(make_box({x, 0, z}, {x + 3, 2, z + 4})), soil, 1);
      if (z == 0.0) {
        const std::vector<int> faces = outer_faces(*block.solid, {{0, 0, 0}, -Vector3::UnitZ()});
        block.quiet.push_back(
            {.where = FaceList{faces}, .driving = wave_loads(*block.solid, faces, soil, wave)});
      }
      scene.blocks.push_back(std::move(block));
    }
  }
  scene.motions.resize(scene.blocks.size());
  return scene;
}

template <class Run>
End alone(const Scene& scene, const Run& run) {
  std::vector<BlockModel> blocks;
  for (const BlockDefinition& block : scene.blocks) blocks.emplace_back(block);
  Simulation simulation(std::move(blocks), scene.motions, same_law(scene.law), scene.settings);
  run(simulation);
  return end_of(simulation);
}

template <class Run>
End shared(const Scene& scene, const std::vector<int>& owners, int ranks, const Run& run,
           const Rebalancing& balance = {}) {
  End end;
  run_on_threads(ranks, [&](Ranks& own) {
    const auto load = [&](int block) { return BlockModel(scene.blocks[at(block)]); };
    BlocksOfRank blocks = share_blocks(own, owners, load, scene.settings, {}, nullptr, own.own() == 0);
    blocks.shared->balance = balance;
    Simulation simulation(std::move(blocks), scene.motions, same_law(scene.law), scene.settings);
    run(simulation);
    End here = end_of(simulation);
    if (own.own() == 0) end = std::move(here);
  });
  return end;
}

/// 60 steps, in which the wave passes, from equilibrium.
void shake(Simulation& simulation) {
  ASSERT_EQ(simulation.start_from_statics(), StaticStatus::equilibrium);
  EXPECT_TRUE(advance(simulation, 60));
}

void expect_same(const End& one, const End& other) {
  EXPECT_LT(test_support::distance(one, other), 1e-9);
  const Ledger& a = one.totals.ledger;
  const Ledger& b = other.totals.ledger;
  EXPECT_NEAR(a.damping, b.damping, 1e-6 * a.damping);
  EXPECT_NEAR(a.applied, b.applied, 1e-6 * a.damping);
}

TEST(SharedQuietBoundaries, AWavePassesAsOnOneRank) {
  for (const Integrator integrator : {Integrator::dda, Integrator::generalized_alpha}) {
    const Scene scene = ground(integrator);
    const End one = alone(scene, shake);
    EXPECT_GT(one.totals.ledger.damping, 0.0);
    expect_same(one, shared(scene, {0, 1, 0, 1}, 2, shake));
    expect_same(one, shared(scene, {1, 2, 0, 1}, 3, shake));
  }
}

TEST(SharedQuietBoundaries, TheReactionOfRestIsThatOfAllRanks) {
  const Scene scene = ground(Integrator::dda);
  (void)shared(scene, {0, 1, 1, 0}, 2, [](Simulation& simulation) {
    ASSERT_EQ(simulation.start_from_statics(), StaticStatus::equilibrium);
    EXPECT_TRUE(advance(simulation, 1));
    // rho g of all four blocks of 24 m^3. Each rank knows the reactions of its ghosts, too.
    double sum = 0.0;
    for (const int block : {0, 1}) {
      const BlockModel& base = simulation.blocks()[at(block)];
      EXPECT_FALSE(base.holds_quiet_faces());
      sum += std::sqrt(base.basis().volume()) * base.reaction()(0, 2);
    }
    EXPECT_NEAR(sum, 2000.0 * 10.0 * 96.0, 1e-2);
    // Statics hold the base again.
    EXPECT_EQ(run_static(simulation, 0.1), StaticStatus::equilibrium);
    EXPECT_TRUE(simulation.blocks()[0].holds_quiet_faces());
  });
}

TEST(SharedQuietBoundaries, CheckpointsGoOnWithAnyNumberOfRanks) {
  const Scene scene = ground(Integrator::dda);
  const End one = alone(scene, shake);
  std::string stored;
  (void)shared(scene, {0, 1, 2, 2}, 3, [&](Simulation& simulation) {
    ASSERT_EQ(simulation.start_from_statics(), StaticStatus::equilibrium);
    EXPECT_TRUE(advance(simulation, 20));
    simulation.gather_results();
    const SimulationSnapshot snapshot = simulation.snapshot();
    if (simulation.system().share()->ranks().own() == 0) stored = to_bytes(snapshot);
  });
  const auto go_on = [&](Simulation& simulation) {
    simulation.restore(snapshot_from_bytes(stored));
    EXPECT_TRUE(advance(simulation, 60));
  };
  expect_same(one, alone(scene, go_on));
  expect_same(one, shared(scene, {0, 1, 0, 1}, 2, go_on));
}

TEST(SharedQuietBoundaries, BlocksTakeTheirReactionsToOtherRanks) {
  const Scene scene = ground(Integrator::dda);
  Rebalancing balance;
  balance.interval = 20;
  balance.partition = [](Ranks&, const std::vector<PartitionBlock>&, int) {
    return std::vector<int>{1, 0, 1, 0};
  };
  const End end = shared(scene, {0, 0, 0, 1}, 2, shake, balance);
  EXPECT_EQ(end.work[0].repartitions, 1);
  expect_same(alone(scene, shake), end);
}

}  // namespace
}  // namespace ashlar::shared_quiet_boundaries_test
