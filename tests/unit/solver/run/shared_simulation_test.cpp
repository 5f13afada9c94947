// Simulations whose blocks several ranks share.
#include <algorithm>
#include <array>
#include <mutex>
#include <random>

#include "geometry/index.hpp"
#include "solver/ranks/thread_ranks.hpp"
#include "solver/run/gathered_run.hpp"
#include "support/simulations.hpp"

namespace ashlar::shared_simulation_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;

struct Scene {
  std::vector<BlockDefinition> blocks;
  std::vector<InitialMotion> motions;
  JointLaw law;
  SimulationSettings settings;
};

JointLaw joint(double friction) {
  JointLaw law;
  law.normal_stiffness = 1e9;
  law.shear_stiffness = 5e8;
  law.friction = friction;
  return law;
}

/// Running bond on a fixed base, bricks of 0.4 x 0.2 x 0.2 m. Every other course has one less.
Scene wall(int courses, int bricks, int order = 1) {
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
Scene pile(int layers, int order) {
  Scene scene;
  scene.law = joint(0.5);
  scene.settings.time_step = 2e-3;
  scene.settings.contact_distance = 2e-3;
  scene.blocks.push_back(fixed_box({-2, -2, -0.5}, {4, 2, 0}));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  for (int layer = 0; layer < layers; ++layer) {
    for (int k = 0; k < 5; ++k) {
      const Vector3 middle(0.45 * k + 0.05 * part(random), 0.05 * part(random), 0.2 + 0.34 * layer);
      const Vector3 half(0.2, 0.15, 0.12);
      const Eigen::AngleAxisd turn(0.3 * part(random), Vector3(part(random), 1.0, 0.2).normalized());
      scene.blocks.push_back(block_of(
          "stone", test_support::turned(Polyhedron(make_box(middle - half, middle + half)), turn, middle),
          {2500, 1e9, 0.2}, order));
    }
  }
  scene.motions.resize(scene.blocks.size());
  return scene;
}

/// Ranks of blocks by their place along x.
std::vector<int> owners_of(const Scene& scene, int ranks) {
  std::vector<double> places;
  for (const BlockDefinition& block : scene.blocks)
    places.push_back(box_of(block.solid->mesh().points).low.x());
  std::vector<double> sorted = places;
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> owners;
  for (const double place : places) {
    const auto rank = std::lower_bound(sorted.begin(), sorted.end(), place) - sorted.begin();
    owners.push_back(static_cast<int>(rank * ranks / static_cast<std::ptrdiff_t>(sorted.size())));
  }
  return owners;
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

bool advance(Simulation& simulation, int steps) {
  while (simulation.steps() < steps)
    if (simulation.step(1e3) != StepStatus::accepted) return false;
  return true;
}

End end_of(const Simulation& simulation) {
  return {states_of_run(simulation),         totals_of_run(simulation),
          contacts_of_run(simulation),       simulation.steps(),
          work_of_ranks(simulation),         simulation.rejections(),
          simulation.largest_step_residual()};
}

End run_alone(const Scene& scene, int steps) {
  std::vector<BlockModel> blocks;
  for (const BlockDefinition& block : scene.blocks) blocks.emplace_back(block);
  Simulation simulation(std::move(blocks), scene.motions, test_support::same_law(scene.law), scene.settings);
  EXPECT_TRUE(advance(simulation, steps));
  return end_of(simulation);
}

End run_shared(const Scene& scene, const std::vector<int>& owners, int ranks, int steps) {
  End end;
  run_on_threads(ranks, [&](Ranks& own) {
    const auto load = [&](int block) { return BlockModel(scene.blocks[at(block)]); };
    Simulation simulation(share_blocks(own, owners, load, scene.settings), scene.motions,
                          test_support::same_law(scene.law), scene.settings);
    EXPECT_TRUE(advance(simulation, steps));
    End here = end_of(simulation);
    if (own.own() == 0) end = std::move(here);
  });
  return end;
}

/// Largest difference of positions, m.
double distance(const End& a, const End& b) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.states.size(); ++k)
    most = std::max(most, (a.states[k].position - b.states[k].position).norm());
  return most;
}

bool same_bits(const End& a, const End& b) {
  for (std::size_t k = 0; k < a.states.size(); ++k)
    if (a.states[k].position != b.states[k].position || a.states[k].velocity != b.states[k].velocity)
      return false;
  return a.states.size() == b.states.size() && a.totals.ledger.balance() == b.totals.ledger.balance();
}

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

/// A block that slides over slabs of other ranks, without friction.
TEST(SharedSimulation, ABlockSlidesAcrossTheSlabsOfAllRanks) {
  Scene scene;
  scene.law = joint(0.0);
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
  scene.law = joint(0.5);
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
    const End alone = run_alone(scene, 60);
    const End shared = run_shared(scene, owners_of(scene, 3), 3, 60);
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
  Scene multipliers = scene;
  multipliers.settings.augmented = true;
  EXPECT_THROW(run_shared(multipliers, owners_of(scene, 2), 2, 1), std::invalid_argument);
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
  std::vector<BlockModel> blocks;
  for (const BlockDefinition& block : scene.blocks) blocks.emplace_back(block);
  Simulation alone(std::move(blocks), scene.motions, test_support::same_law(scene.law), scene.settings);
  ASSERT_TRUE(advance(alone, 20));
  EXPECT_GT(areas_of(alone)[1], 0.1);
  run_on_threads(2, [&](Ranks& own) {
    const auto load = [&](int block) { return BlockModel(scene.blocks[at(block)]); };
    Simulation simulation(
        share_blocks(own, owners_of(scene, 2), load, scene.settings, {}, nullptr, own.own() == 0),
        scene.motions, test_support::same_law(scene.law), scene.settings);
    ASSERT_TRUE(advance(simulation, 10));
    simulation.gather_results();
    ASSERT_TRUE(advance(simulation, 20));
    simulation.gather_results();
    if (own.own() != 0) return;
    EXPECT_NEAR(areas_of(simulation)[0], areas_of(alone)[0], 1e-9);
    EXPECT_NEAR(areas_of(simulation)[1], areas_of(alone)[1], 1e-9);
  });
}

TEST(SharedSimulation, TheFirstRankHasTheResultsOfTheRun) {
  const Scene scene = wall(3, 4);
  run_on_threads(2, [&](Ranks& own) {
    const auto load = [&](int block) { return BlockModel(scene.blocks[at(block)]); };
    Simulation simulation(
        share_blocks(own, owners_of(scene, 2), load, scene.settings, {}, nullptr, own.own() == 0),
        scene.motions, test_support::same_law(scene.law), scene.settings);
    ASSERT_TRUE(advance(simulation, 20));
    simulation.gather_results();
    if (own.own() != 0) return;
    const End alone = run_alone(scene, 20);
    EXPECT_EQ(simulation.contacts().size(), alone.contacts.size());
    EXPECT_EQ(simulation.unknowns(), alone.totals.unknowns);
    EXPECT_EQ(simulation.report().locked, alone.totals.report.locked);
    for (std::size_t k = 0; k < alone.states.size(); ++k)
      EXPECT_LT((simulation.states()[k].position - alone.states[k].position).norm(), 1e-10);
  });
}

}  // namespace
}  // namespace ashlar::shared_simulation_test
