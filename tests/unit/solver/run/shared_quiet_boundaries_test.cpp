// Quiet faces of blocks that several ranks share: the reaction of rest, waves as on one rank, checkpoints.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/shared_runs.hpp"

namespace ashlar::shared_quiet_boundaries_test {
namespace {

using test_support::advance;
using test_support::block_of;
using test_support::distance;
using test_support::End;
using test_support::looking_each;
using test_support::run_alone;
using test_support::run_shared;
using test_support::run_static;
using test_support::Scene;
using test_support::spring_joint;
using test_support::stored_snapshot;

/// lambda = mu = 8e7 Pa.
const Material soil{2000.0, 2e8, 0.25};

/// Two columns of two blocks beside each other, on a quiet base with a wave across. Blocks 0 and 1 are at the base.
Scene ground(Integrator integrator) {
  Scene scene;
  scene.law = spring_joint(0.6);
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

/// 60 steps, in which the wave passes, from equilibrium.
void shake(Simulation& simulation) {
  ASSERT_EQ(simulation.start_from_statics(), StaticStatus::equilibrium);
  EXPECT_TRUE(advance(simulation, 60));
}

void expect_same(const End& one, const End& other) {
  EXPECT_LT(distance(one, other), 1e-9);
  const Ledger& a = one.totals.ledger;
  const Ledger& b = other.totals.ledger;
  EXPECT_NEAR(a.damping, b.damping, 1e-6 * a.damping);
  EXPECT_NEAR(a.applied, b.applied, 1e-6 * a.damping);
}

TEST(SharedQuietBoundaries, AWavePassesAsOnOneRank) {
  for (const Integrator integrator : {Integrator::dda, Integrator::generalized_alpha}) {
    const Scene scene = ground(integrator);
    const End one = run_alone(scene, shake);
    EXPECT_GT(one.totals.ledger.damping, 0.0);
    expect_same(one, run_shared(scene, {0, 1, 0, 1}, 2, shake));
    expect_same(one, run_shared(scene, {1, 2, 0, 1}, 3, shake));
  }
}

TEST(SharedQuietBoundaries, TheReactionOfRestIsThatOfAllRanks) {
  const Scene scene = ground(Integrator::dda);
  (void)run_shared(scene, {0, 1, 1, 0}, 2, [](Simulation& simulation) {
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
  const End one = run_alone(scene, shake);
  const std::string stored = run_shared(scene, {0, 1, 2, 2}, 3, [](Simulation& simulation) {
    EXPECT_EQ(simulation.start_from_statics(), StaticStatus::equilibrium);
    EXPECT_TRUE(advance(simulation, 20));
    return stored_snapshot(simulation);
  });
  const auto go_on = [&](Simulation& simulation) {
    simulation.restore(snapshot_from_bytes(stored));
    EXPECT_TRUE(advance(simulation, 60));
  };
  expect_same(one, run_alone(scene, go_on));
  expect_same(one, run_shared(scene, {0, 1, 0, 1}, 2, go_on));
}

TEST(SharedQuietBoundaries, BlocksTakeTheirReactionsToOtherRanks) {
  const Scene scene = ground(Integrator::dda);
  const auto partition = [](Ranks&, const std::vector<PartitionBlock>&, int) {
    return std::vector<int>{1, 0, 1, 0};
  };
  const End end = run_shared(scene, {0, 0, 0, 1}, 2, shake, looking_each(20, partition));
  EXPECT_EQ(end.work[0].repartitions, 1);
  expect_same(run_alone(scene, shake), end);
}

}  // namespace
}  // namespace ashlar::shared_quiet_boundaries_test
