// Simulations whose blocks several ranks share.
#include <algorithm>
#include <array>
#include <random>

#include "support/shared_runs.hpp"

namespace ashlar::shared_simulation_test {
namespace {

using test_support::advance;
using test_support::block_of;
using test_support::distance;
using test_support::End;
using test_support::fixed_box;
using test_support::owners_of;
using test_support::pile;
using test_support::run_alone;
using test_support::run_shared;
using test_support::same_bits;
using test_support::Scene;
using test_support::spring_joint;
using test_support::wall;

TEST(SharedSimulation, OneRankHasTheBitsOfNone) {
  const Scene scene = pile(4, 1);
  const End alone = run_alone(scene, 100);
  const End shared = run_shared(scene, owners_of(scene, 1), 1, 100);
  EXPECT_TRUE(same_bits(alone, shared));
  EXPECT_EQ(alone.rejections.size(), shared.rejections.size());
  EXPECT_EQ(shared.work[0].ghosts, 0);
}

TEST(SharedSimulation, AWallStandsAlikeOnAnyNumberOfRanks) {
  const Scene scene = wall(6, 8);
  const End alone = run_alone(scene, 80);
  for (const int ranks : {2, 4}) {
    const End shared = run_shared(scene, owners_of(scene, ranks), ranks, 80);
    EXPECT_LT(distance(alone, shared), 1e-9);
    EXPECT_NEAR(alone.totals.ledger.balance(), shared.totals.ledger.balance(),
                1e-9 * std::abs(alone.totals.ledger.gravity));
    EXPECT_EQ(alone.contacts.size(), shared.contacts.size());
    int own = 0;
    for (const RankWork& work : shared.work) {
      own += work.own;
      EXPECT_LT(work.own + work.ghosts, ranks == 2 ? 36 : 28);
    }
    EXPECT_EQ(own, 46);
  }
}

TEST(SharedSimulation, ABaseWithoutUnknownsMovesAWall) {
  // Supports on two faces leave the base no motion of its own: its part of the shared equations has no rows.
  Scene scene = wall(3, 4);
  BlockDefinition base =
      block_of("base", Polyhedron(make_box({-1, -1, -0.5}, {2.6, 1, 0})), {2000, 1e9, 0.2}, 1);
  const SupportHistory history{{0.0, 1.0}, {Vector3(2, 0, 0), Vector3(2, 0, 0)}, MotionRecord::acceleration};
  for (const double z : {-0.5, 0.0})
    base.supports.push_back(
        {Plane{{0, 0, z}, z < 0.0 ? Vector3(-Vector3::UnitZ()) : Vector3(Vector3::UnitZ())},
         {true, true, true},
         history});
  ASSERT_EQ(BlockModel(base).unknowns(), 0);
  scene.blocks.front() = base;
  const End alone = run_alone(scene, 40);
  // 2 m/s^2 for 80 ms: friction carries the bricks of 0.016 m3 along by 6.4 mm.
  const double moved =
      (alone.states[1].position - BlockModel(scene.blocks[1]).initial_state().position)(0, 0);
  EXPECT_NEAR(moved / std::sqrt(0.016), 6.4e-3, 6.4e-4);
  for (const int ranks : {2, 4}) {
    const End shared = run_shared(scene, owners_of(scene, ranks), ranks, 40);
    EXPECT_LT(distance(alone, shared), 1e-9) << ranks;
  }
}

TEST(SharedSimulation, AFactorOfTheSharedIslandServesLaterSteps) {
  // Order 3: a factor of 5 bricks costs more than twenty solutions.
  const Scene scene = wall(2, 3, 3);
  const End alone = run_alone(scene, 12);
  ASSERT_LT(alone.totals.counts.factors.factorizations, 6u);
  const End shared = run_shared(scene, owners_of(scene, 2), 2, 12);
  EXPECT_LT(distance(alone, shared), 1e-9);
  EXPECT_GE(shared.work[0].shared.solves, 12u);
  EXPECT_LT(shared.work[0].shared.factorizations, 6u);
  const auto iterations = static_cast<double>(alone.totals.counts.open_close_iterations);
  EXPECT_NEAR(static_cast<double>(shared.totals.counts.open_close_iterations), iterations, 0.1 * iterations);
}

TEST(SharedSimulation, APileFallsAlikeOnAnyNumberOfRanks) {
  const Scene scene = pile(6, 1);
  const End alone = run_alone(scene, 110);
  for (const int ranks : {2, 4}) {
    const End shared = run_shared(scene, owners_of(scene, ranks), ranks, 110);
    EXPECT_LT(distance(alone, shared), 1e-9);
    EXPECT_LT(shared.largest_step_residual, 1e-9 * shared.totals.ledger.kinetic);
    EXPECT_GT(shared.contacts.size(), 20u);
  }
}

TEST(SharedSimulation, TheClosestJointIsFoundAmongThoseOfAllRanks) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    Scene scene = wall(4, 4);
    scene.law.largest_closure = 5e-5;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> speed(-0.05, 0.05);
    for (std::size_t k = 1; k < scene.motions.size(); ++k)
      scene.motions[k].velocity = {speed(random), speed(random), speed(random)};
    const MostClosed one = run_alone(scene, 30).totals.extremes.most_closed;
    EXPECT_GT(one.share, 0.3);
    for (const int ranks : {2, 3}) {
      const MostClosed shared =
          run_shared(scene, owners_of(scene, ranks), ranks, 30).totals.extremes.most_closed;
      EXPECT_EQ(shared.blocks, one.blocks) << seed;
      EXPECT_NEAR(shared.time, one.time, 1e-12);
      EXPECT_NEAR(shared.share, one.share, 1e-6) << seed;
    }
  }
}

/// A block that slides over slabs of other ranks, without friction.
TEST(SharedSimulation, ABlockSlidesAcrossTheSlabsOfAllRanks) {
  Scene scene;
  scene.law = spring_joint(0.0);
  scene.settings.time_step = 5e-3;
  scene.settings.contact_distance = 2e-3;
  for (int k = 0; k < 8; ++k) scene.blocks.push_back(fixed_box({0.5 * k, -1, -0.5}, {0.5 * (k + 1), 1, 0}));
  for (int k = 0; k < 8; ++k) {
    // Far enough from the slider's way not to touch it, but a body of each rank.
    const Vector3 low(0.5 * k + 0.1, 0.6, 0.0);
    scene.blocks.push_back(
        block_of("post", Polyhedron(make_box(low, low + Vector3(0.2, 0.2, 0.2))), {2000, 1e9, 0.2}, 1));
  }
  scene.blocks.push_back(
      block_of("slider", Polyhedron(make_box({0.1, -0.2, 0.0}, {0.5, 0.2, 0.2})), {2000, 1e9, 0.2}, 1));
  scene.motions.resize(scene.blocks.size());
  scene.motions.back().velocity = {3.0, 0.0, 0.0};
  std::vector<int> owners;
  for (int k = 0; k < 16; ++k) owners.push_back(k % 8 / 2);
  owners.push_back(0);
  const End alone = run_alone(scene, 200);
  const End shared = run_shared(scene, owners, 4, 200);
  EXPECT_GT(alone.totals.momentum.x(), 0.999 * 32.0 * 2.0 * 3.0);
  EXPECT_LT(distance(alone, shared), 1e-9);
  // The slider is at 3.1 m: its rank has the slabs below it, of the last rank, as ghosts.
  EXPECT_GE(shared.work[0].ghosts, 1);
}

/// Two stacks of two cubes come to rest, the first one on two ranks. Later a block falls on it and wakes it.
TEST(SharedSimulation, AllRanksPutTheSameIslandsToSleepAndWakeThem) {
  Scene scene;
  scene.law = spring_joint(0.5);
  scene.settings.time_step = 2e-3;
  scene.blocks.push_back(fixed_box({-5, -5, -1}, {5, 5, 0}));
  for (const double x : {0.0, 3.0}) {
    for (const double z : {0.0, 1.0})
      scene.blocks.push_back(
          block_of("cube", Polyhedron(make_box({x, 0, z}, {x + 1, 1, z + 1})), {2500, 1e9, 0.2}, 1));
  }
  scene.blocks.push_back(
      block_of("late", Polyhedron(make_box({0.2, 0.2, 8}, {0.8, 0.8, 8.5})), {2500, 1e9, 0.2}, 1));
  scene.motions.resize(scene.blocks.size());
  const std::vector<int> owners = {0, 0, 1, 1, 1, 0};
  const End asleep = run_shared(scene, owners, 2, 500);
  EXPECT_EQ(asleep.totals.counts.islands_put_to_sleep, 2u);
  EXPECT_EQ(asleep.states[1].velocity.norm() + asleep.states[2].velocity.norm(), 0.0);
  const End alone = run_alone(scene, 620);
  const End shared = run_shared(scene, owners, 2, 620);
  EXPECT_GT(alone.states[2].velocity.norm(), 0.0);
  EXPECT_EQ(alone.totals.counts.sleeping_block_steps, shared.totals.counts.sleeping_block_steps);
  EXPECT_LT(distance(alone, shared), 1e-9);
  EXPECT_NEAR(alone.totals.ledger.balance(), shared.totals.ledger.balance(),
              1e-9 * std::abs(alone.totals.ledger.gravity));
}

TEST(SharedSimulation, CurvedAndRigidBlocksStandAlike) {
  for (const int order : {0, 2}) {
    const Scene scene = wall(2, 2, order);
    const End alone = run_alone(scene, 30);
    const End shared = run_shared(scene, owners_of(scene, 2), 2, 30);
    EXPECT_LT(distance(alone, shared), 1e-9) << order;
  }
}

TEST(SharedSimulation, EveryIntegratorMovesAlike) {
  for (const Integrator integrator : {Integrator::average_acceleration, Integrator::generalized_alpha}) {
    Scene scene = pile(2, 1);
    scene.settings.integrator = integrator;
    scene.settings.stiffness_damping = 1e-4;
    scene.law.damping = 0.1;
    // Blocks that spin shorten the steps: more of them lead to as many contacts.
    const End alone = run_alone(scene, 120);
    const End shared = run_shared(scene, owners_of(scene, 3), 3, 120);
    EXPECT_LT(distance(alone, shared), 1e-9);
    EXPECT_NEAR(alone.totals.ledger.damping, shared.totals.ledger.damping,
                1e-9 * alone.totals.ledger.damping);
    EXPECT_GT(shared.contacts.size(), 5u);
  }
}

TEST(SharedSimulation, StepsAreCutAlike) {
  Scene scene = pile(2, 1);
  scene.settings.time_step = 2e-2;
  for (InitialMotion& motion : scene.motions) motion.velocity = {0.0, 0.0, -4.0};
  scene.motions.front() = {};
  const End alone = run_alone(scene, 15);
  const End shared = run_shared(scene, owners_of(scene, 2), 2, 15);
  EXPECT_GT(alone.rejections.size(), 0u);
  EXPECT_EQ(alone.rejections.size(), shared.rejections.size());
  EXPECT_LT(distance(alone, shared), 1e-7);
}

TEST(SharedSimulation, RefusesWhatSeveralRanksCannotDo) {
  const Scene scene = wall(2, 2);
  EXPECT_THROW(run_on_threads(2,
                              [&](Ranks& own) {
                                const auto load = [&](int block) -> BlockModel {
                                  if (block == 3) throw std::invalid_argument("block 3 is open");
                                  return BlockModel(scene.blocks[at(block)]);
                                };
                                (void)share_blocks(own, owners_of(scene, 2), load, scene.settings);
                              }),
               std::invalid_argument);
}

/// Bricks of the top course leave a wall whose joints have strength.
TEST(SharedSimulation, TheFirstRankKnowsTheBrokenJointsOfAll) {
  Scene scene = wall(2, 4);
  scene.law.cohesion = 1e4;
  scene.law.tensile_strength = 1e3;
  for (std::size_t k = 5; k < scene.motions.size(); ++k) scene.motions[k].velocity = {0.0, 0.0, 1.0};
  const auto areas_of = [](const Simulation& simulation) {
    std::array<double, 2> areas{0.0, 0.0};
    for (const auto& [blocks, pair] : simulation.histories()) {
      areas[0] += pair.bonded;
      areas[1] += pair.broken;
    }
    return areas;
  };
  const std::array<double, 2> alone = run_alone(scene, [&](Simulation& simulation) {
    EXPECT_TRUE(advance(simulation, 20));
    return areas_of(simulation);
  });
  EXPECT_GT(alone[1], 0.1);
  const std::array<double, 2> shared = run_shared(scene, owners_of(scene, 2), 2, [&](Simulation& simulation) {
    EXPECT_TRUE(advance(simulation, 10));
    simulation.gather_results();
    EXPECT_TRUE(advance(simulation, 20));
    simulation.gather_results();
    return areas_of(simulation);
  });
  EXPECT_NEAR(shared[0], alone[0], 1e-9);
  EXPECT_NEAR(shared[1], alone[1], 1e-9);
}

TEST(SharedSimulation, TheFirstRankHasTheResultsOfTheRun) {
  const Scene scene = wall(3, 4);
  (void)run_shared(scene, owners_of(scene, 2), 2, [&](Simulation& simulation) {
    ASSERT_TRUE(advance(simulation, 20));
    simulation.gather_results();
    if (!simulation.system().exchange().first()) return;
    const End alone = run_alone(scene, 20);
    EXPECT_EQ(simulation.contacts().size(), alone.contacts.size());
    EXPECT_EQ(simulation.unknowns(), alone.totals.unknowns);
    EXPECT_EQ(simulation.report().locked, alone.totals.report.locked);
    for (std::size_t k = 0; k < alone.states.size(); ++k)
      EXPECT_LT((simulation.states()[k].position - alone.states[k].position).norm(), 1e-10);
  });
}

/// A bar of four blocks that are tied to each other, one on each rank, flies and turns.
TEST(SharedSimulation, TiedBlocksOfSeveralRanksTurnAsOne) {
  Scene scene;
  scene.law = spring_joint(0.5);
  scene.settings.time_step = 2e-3;
  scene.settings.gravity = Vector3::Zero();
  scene.blocks.push_back(fixed_box({-9, -9, -9}, {-8, -8, -8}));
  scene.motions.emplace_back();
  const Vector3 spin(0.0, 1.0, 4.0);
  for (int k = 0; k < 4; ++k) {
    scene.blocks.push_back(
        block_of("part", Polyhedron(make_box({k - 2.0, 0, 0}, {k - 1.0, 0.4, 0.4})), {2000, 1e8, 0.2}, 1));
    // About the centroid of the bar.
    scene.motions.push_back({spin.cross(Vector3(k - 1.5, 0.0, 0.0)), spin});
    if (k > 0) scene.ties.push_back({k, k + 1, 1e11});
  }
  const End start = run_alone(scene, 0);
  const End alone = run_alone(scene, 150);
  for (const std::vector<int>& owners : {std::vector<int>{0, 0, 0, 1, 1}, {0, 0, 1, 2, 3}, {0, 1, 0, 1, 0}}) {
    const int ranks = *std::max_element(owners.begin(), owners.end()) + 1;
    const End shared = run_shared(scene, owners, ranks, 150);
    EXPECT_LT(distance(alone, shared), 1e-8);
    EXPECT_LT((shared.totals.momentum - start.totals.momentum).norm(), 1e-8);
    EXPECT_LT((shared.totals.angular_momentum - start.totals.angular_momentum).norm(),
              1e-8 * start.totals.angular_momentum.norm());
    EXPECT_LT((shared.totals.angular_momentum - alone.totals.angular_momentum).norm(),
              1e-11 * start.totals.angular_momentum.norm());
    EXPECT_LT(shared.largest_step_residual, 1e-9 * start.totals.ledger.kinetic);
  }
}

/// Tied blocks fall on a wall: with springs and with multipliers.
TEST(SharedSimulation, TiedBlocksOfSeveralRanksFallAlike) {
  for (const bool augmented : {false, true}) {
    Scene scene = wall(3, 6);
    scene.settings.augmented = augmented;
    const int first = static_cast<int>(scene.blocks.size());
    for (int k = 0; k < 3; ++k) {
      const Vector3 low(0.5 + 0.4 * k, 0.02, 0.602 + 0.05);
      scene.blocks.push_back(
          block_of("beam", Polyhedron(make_box(low, low + Vector3(0.4, 0.16, 0.2))), {2000, 1e9, 0.2}, 1));
    }
    scene.motions.resize(scene.blocks.size());
    scene.ties = {{first, first + 1, 1e11}, {first + 1, first + 2, 1e11}};
    const End alone = run_alone(scene, 80);
    const End shared = run_shared(scene, owners_of(scene, 3), 3, 80);
    EXPECT_LT(distance(alone, shared), 1e-8);
    EXPECT_NEAR(alone.totals.ledger.contact, shared.totals.ledger.contact,
                1e-6 * alone.totals.ledger.contact + 1e-9);
    EXPECT_LT(shared.largest_step_residual, 1e-8 * std::abs(alone.totals.ledger.gravity));
  }
}

/// A wall under a stress in all directions that nothing outside balances: it moves apart.
TEST(SharedSimulation, BlocksUnderStressStartAlike) {
  for (const bool augmented : {false, true}) {
    Scene scene = wall(3, 6);
    scene.start = [](Simulation& simulation) { simulation.start_stressed(); };
    scene.settings.augmented = augmented;
    for (BlockDefinition& block : scene.blocks)
      block.initial_stress = [](const Vector3& place) -> Eigen::Matrix3d {
        return Vector3(-2e4, -1e3, -1e4 - 1e3 * place.z()).asDiagonal();
      };
    const End alone = run_alone(scene, 30);
    ASSERT_GT(alone.totals.ledger.kinetic, augmented ? 1e-8 : 1e-3);  // multipliers hold no energy
    for (const int ranks : {2, 3}) {
      const End shared = run_shared(scene, owners_of(scene, ranks), ranks, 30);
      EXPECT_LT(distance(alone, shared), 1e-8);
      EXPECT_NEAR(alone.totals.ledger.balance(), shared.totals.ledger.balance(),
                  1e-8 * std::abs(alone.totals.ledger.gravity));
    }
  }
}

}  // namespace
}  // namespace ashlar::shared_simulation_test
