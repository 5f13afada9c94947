// Static analyses, and starts from statics, of simulations whose blocks several ranks share.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "support/shared_runs.hpp"

namespace ashlar::shared_statics_test {
namespace {

using test_support::block_of;
using test_support::owners_along;
using test_support::owners_of;
using test_support::run_alone;
using test_support::run_shared;
using test_support::run_static;
using test_support::Scene;
using test_support::simulation_alone;
using test_support::simulation_on;

constexpr double gravity = 9.81;
constexpr double degree = std::numbers::pi / 180.0;
const Material brick{2000, 1e9, 0.2};

/// Blocks of rigid joints.
struct Placed : Scene {
  explicit Placed(double friction) {
    law = test_support::spring_joint(friction);
    law.rigid = true;
    settings.time_step = 1e-2;
    settings.contact_distance = 2e-3;
  }
  void add(const Vector3& low, const Vector3& high, int order = 1) {
    blocks.push_back(block_of("block", Polyhedron(make_box(low, high)), brick, order));
  }
  void add_fixed(Polyhedron solid) {
    blocks.push_back(block_of("base", std::move(solid), brick, 1));
    blocks.back().fixed = true;
  }
};

Placed wall(int courses, int bricks, int order = 1) {
  Placed scene(0.6);
  scene.blocks = test_support::wall(courses, bricks, order).blocks;
  return scene;
}

/// A semicircular arch of voussoirs between two fixed ones, thick enough to stand.
Placed arch(int voussoirs) {
  Placed scene(0.8);
  for (int k = 0; k < voussoirs; ++k) {
    std::vector<Vector3> points;
    for (const int side : {k, k + 1}) {
      const double angle = std::numbers::pi * (1.0 - static_cast<double>(side) / voussoirs);
      for (const double radius : {1.7, 2.3})
        for (const double y : {0.0, 0.5})
          points.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
    }
    const Polyhedron solid(make_convex_hull(points));
    scene.blocks.push_back(block_of("voussoir", solid, brick, 1));
    scene.blocks.back().fixed = k == 0 || k == voussoirs - 1;
  }
  return scene;
}

/// A cube of 1 m on a slope of 30 degrees down to -x, and fixed blocks at some distances ahead.
Placed on_slope(double friction, const std::vector<double>& ways) {
  Placed scene(friction);
  scene.law.normal_stiffness = scene.law.shear_stiffness = 1e10;
  const auto tilted = [](const Vector3& low, const Vector3& high) {
    return test_support::tilted_box(low, high, 30.0);
  };
  scene.blocks.push_back(block_of("cube", tilted({-0.5, -0.5, 0}, {0.5, 0.5, 1}), brick, 1));
  scene.add_fixed(tilted({-6, -2, -1}, {2, 2, 0}));
  for (const double travel : ways)
    scene.add_fixed(tilted({-1.5 - travel, -2, 0.25}, {-0.5 - travel, 2, 0.75}));
  return scene;
}

/// The end of an analysis. On ranks that of the first one is of all blocks.
struct Verdict {
  StaticStatus status = StaticStatus::balancing;
  std::vector<BlockState> states;
  std::vector<PairRecord> contacts;
  std::vector<MovingBlock> moving;
  int steps = 0;
};

Verdict analyse(Simulation& simulation) {
  const StaticStatus status = run_static(simulation, 1.0);
  simulation.gather_results();
  return {status, simulation.states(), simulation.contacts(), simulation.moving_blocks(), simulation.steps()};
}

double distance(const std::vector<BlockState>& a, const std::vector<BlockState>& b) {
  double most = a.size() == b.size() ? 0.0 : 1e9;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    most = std::max(most, (a[k].position - b[k].position).norm());
  return most;
}

/// Force of contacts on a block, N.
Vector3 force_on(const std::vector<PairRecord>& contacts, int block) {
  Vector3 sum = Vector3::Zero();
  for (const PairRecord& record : contacts) {
    if (record.a == block) sum += force_on_a(record);
    if (record.b == block) sum -= force_on_a(record);
  }
  return sum;
}

TEST(SharedStatics, OneRankHasTheBitsOfNone) {
  const Placed scene = wall(4, 4);
  const Verdict alone = run_alone(scene, analyse);
  const Verdict shared = run_shared(scene, owners_of(scene, 1), 1, analyse);
  EXPECT_EQ(alone.status, StaticStatus::equilibrium);
  EXPECT_EQ(shared.status, StaticStatus::equilibrium);
  EXPECT_EQ(alone.steps, shared.steps);
  EXPECT_EQ(distance(alone.states, shared.states), 0.0);
}

TEST(SharedStatics, AWallStandsAlikeOnAnyNumberOfRanks) {
  const Placed scene = wall(6, 8);
  const Verdict alone = run_alone(scene, analyse);
  const double weight = 45 * 0.016 * 2000 * gravity;
  for (const int ranks : {2, 4}) {
    const Verdict shared = run_shared(scene, owners_of(scene, ranks), ranks, analyse);
    EXPECT_EQ(shared.status, StaticStatus::equilibrium);
    EXPECT_LT(distance(alone.states, shared.states), 1e-9);
    EXPECT_EQ(alone.contacts.size(), shared.contacts.size());
    EXPECT_NEAR(force_on(shared.contacts, 0).z(), -weight, 1e-8 * weight);
  }
}

// Beyond its limit a wall turns over slowly. Rigid blocks of all ranks tell it after as many iterations as on one, and
// accelerations at the onset are not opposed by joints between blocks of two ranks.
TEST(SharedStatics, AWallThatTurnsOverSlowlyIsToldAlike) {
  for (const double share : {1.005, 1.02, 1.03}) {
    Placed scene = wall(5, 3, 0);
    scene.settings.gravity = gravity * Vector3(0.0, share / 5.0, -1.0);
    const Verdict alone = run_alone(scene, analyse);
    const Verdict shared = run_shared(scene, owners_of(scene, 2), 2, analyse);
    EXPECT_EQ(alone.status, StaticStatus::moving) << share;
    EXPECT_EQ(shared.status, StaticStatus::moving) << share;
    EXPECT_LE(alone.steps, 16) << share;
    EXPECT_EQ(shared.steps, alone.steps) << share;
    EXPECT_EQ(shared.moving.size(), alone.moving.size()) << share;
  }
}

// Multipliers hold points within the penetration tolerance of where the path of the iteration leaves them.
TEST(SharedStatics, MultipliersHoldAWallAndAnArchAlike) {
  for (Placed scene : {wall(4, 4), arch(13)}) {
    scene.settings.augmented = true;
    scene.settings.multipliers.penetration_tolerance = 2e-7;
    const Verdict alone = run_alone(scene, analyse);
    ASSERT_EQ(alone.status, StaticStatus::equilibrium);
    for (const int ranks : {2, 4}) {
      const Verdict shared = run_shared(scene, owners_of(scene, ranks), ranks, analyse);
      EXPECT_EQ(shared.status, StaticStatus::equilibrium);
      EXPECT_LT(distance(alone.states, shared.states), scene.settings.multipliers.penetration_tolerance);
      EXPECT_LT((force_on(alone.contacts, 0) - force_on(shared.contacts, 0)).norm(),
                1e-4 * force_on(alone.contacts, 0).norm());
    }
  }
}

TEST(SharedStatics, CurvedAndRigidBlocksStandAlike) {
  for (const int order : {0, 2}) {
    const Placed scene = wall(2, 2, order);
    const Verdict alone = run_alone(scene, analyse);
    const Verdict shared = run_shared(scene, owners_along(2, scene.blocks, 2), 2, analyse);
    EXPECT_EQ(shared.status, StaticStatus::equilibrium) << order;
    EXPECT_LT(distance(alone.states, shared.states), 1e-9) << order;
  }
}

TEST(SharedStatics, AnArchStandsAlike) {
  const Placed scene = arch(13);
  const Verdict alone = run_alone(scene, analyse);
  ASSERT_EQ(alone.status, StaticStatus::equilibrium);
  for (const int ranks : {2, 4}) {
    const Verdict shared = run_shared(scene, owners_of(scene, ranks), ranks, analyse);
    EXPECT_EQ(shared.status, StaticStatus::equilibrium);
    EXPECT_LT(distance(alone.states, shared.states), 1e-8);
    EXPECT_LT((force_on(alone.contacts, 0) - force_on(shared.contacts, 0)).norm(),
              1e-6 * force_on(alone.contacts, 0).norm());
  }
}

/// Two cubes on each other, of two ranks, slide down with g (sin 30 - 0.3 cos 30); two others stand.
TEST(SharedStatics, BlocksOfTwoRanksSlide) {
  Placed scene = on_slope(0.3, {});
  scene.blocks.push_back(
      block_of("upper", test_support::tilted_box({-0.5, -0.5, 1}, {0.5, 0.5, 2}, 30.0), brick, 1));
  scene.add_fixed(Polyhedron(make_box({10, 0, 0}, {12, 2, 1})));
  scene.add({10.5, 0.5, 1}, {11.5, 1.5, 2});
  scene.add({10.5, 0.5, 2}, {11.5, 1.5, 3});
  const std::vector<int> owners = {0, 0, 1, 1, 1, 0};
  const Verdict alone = run_alone(scene, analyse);
  ASSERT_EQ(alone.status, StaticStatus::moving);
  const Verdict shared = run_shared(scene, owners, 2, analyse);
  EXPECT_EQ(shared.status, StaticStatus::moving);
  ASSERT_EQ(shared.moving.size(), 2u);
  ASSERT_EQ(alone.moving.size(), 2u);
  const double along = gravity * (std::sin(30 * degree) - 0.3 * std::cos(30 * degree));
  for (const std::size_t k : {0u, 1u}) {
    EXPECT_EQ(shared.moving[k].block, k == 0 ? 0 : 2);
    EXPECT_NEAR(shared.moving[k].acceleration.norm(), along, 1e-3 * along);
  }
}

/// Blocks on the way of certain motion that were no ghosts when it began.
TEST(SharedStatics, AnObstacleOfAnotherRankAheadIsDetected) {
  for (const double travel : {0.3, 5e-4}) {
    Placed scene = on_slope(0.0, {travel});
    // A body of the other rank.
    scene.add_fixed(Polyhedron(make_box({10, 0, 0}, {12, 2, 1})));
    scene.add({10.5, 0.5, 1}, {11.5, 1.5, 2});
    const Verdict shared = run_shared(scene, {0, 0, 1, 1, 1}, 2, analyse);
    EXPECT_EQ(shared.status, StaticStatus::equilibrium) << travel;
    const Verdict alone = run_alone(scene, analyse);
    EXPECT_EQ(alone.status, StaticStatus::equilibrium) << travel;
    EXPECT_LT(distance(alone.states, shared.states), 1e-7);
  }
  const Verdict free = run_shared(on_slope(0.0, {1.5}), {0, 0, 1}, 2, analyse);
  EXPECT_EQ(free.status, StaticStatus::moving);
  EXPECT_LT(free.steps, 12);
}

/// A plank leans on a wall at 50 degrees. Without width it needs a friction of 0.35.
TEST(SharedStatics, TheVerdictOfRigidBlocksIsToldToAllRanks) {
  for (const double friction : {0.30, 0.34, 0.37, 0.5}) {
    Placed scene(friction);
    const Vector3 along(std::cos(50 * degree), 0, std::sin(50 * degree));
    const Vector3 across(-std::sin(50 * degree), 0, std::cos(50 * degree));
    const Vector3 foot = -3.0 * std::cos(50 * degree) * Vector3::UnitX();
    std::vector<Vector3> points;
    for (const double y : {-0.2, 0.2})
      for (const Vector3& corner : {Vector3(foot), Vector3(foot + 0.1 * across), Vector3(foot + 3.0 * along),
                                    Vector3(foot + 3.0 * along + 0.1 * across)})
        points.push_back(corner + y * Vector3::UnitY());
    scene.blocks.push_back(block_of("ladder", Polyhedron(make_convex_hull(points)), brick, 0));
    scene.add_fixed(Polyhedron(make_box({-5, -1, -1}, {2, 1, 0})));
    scene.add_fixed(Polyhedron(make_box({0, -1, 0}, {1, 1, 5})));
    scene.add({-4, -0.5, 0}, {-3.5, 0, 0.5}, 0);
    const Verdict alone = run_alone(scene, analyse);
    EXPECT_EQ(alone.status, friction < 0.35 ? StaticStatus::moving : StaticStatus::equilibrium);
    run_on_threads(2, [&](Ranks& own) {
      Simulation simulation = simulation_on(own, scene, {1, 0, 0, 0});
      EXPECT_EQ(run_static(simulation, 1.0), alone.status) << friction;
      simulation.gather_results();
      if (own.own() != 0) return;
      const auto moving = simulation.moving_blocks();
      ASSERT_EQ(moving.size(), alone.moving.size());
      for (const MovingBlock& block : moving) EXPECT_EQ(block.block, 0);
    });
  }
}

/// Cubes of two ranks fly, touching each other; so do two of one rank, and one alone. Others stand.
Placed flying() {
  Placed scene(0.5);
  scene.add_fixed(Polyhedron(make_box({-1, -1, -1}, {9, 2, 0})));
  scene.add({0, 0, 0}, {1, 1, 1});
  scene.add({0, 0, 1}, {1, 1, 2});
  scene.add({2, 0, 3}, {3, 1, 4});
  scene.add({3, 0, 3}, {4, 1, 4});
  scene.add({5, 0, 3}, {6, 1, 4});
  scene.add({5, 0, 4}, {6, 1, 5});
  scene.add({7, 0, 3}, {8, 1, 4});
  return scene;
}
const std::vector<int> owners_of_flying = {0, 0, 1, 0, 1, 1, 1, 0};

TEST(SharedStatics, AllRanksKnowTheSameLooseBlocks) {
  const Placed scene = flying();
  const std::vector<std::vector<int>> loose = {{3, 4}, {5, 6}, {7}};
  EXPECT_EQ(simulation_alone(scene).loose_blocks(), loose);
  run_on_threads(
      2, [&](Ranks& own) { EXPECT_EQ(simulation_on(own, scene, owners_of_flying).loose_blocks(), loose); });
}

TEST(SharedStatics, MotionStartsFromTheStaticState) {
  const Placed scene = flying();
  Simulation alone = simulation_alone(scene);
  ASSERT_EQ(alone.start_from_statics(), StaticStatus::equilibrium);
  for (int k = 0; k < 10; ++k) ASSERT_EQ(alone.step(1e3), StepStatus::accepted);
  run_on_threads(2, [&](Ranks& own) {
    Simulation shared = simulation_on(own, scene, owners_of_flying);
    ASSERT_EQ(shared.start_from_statics(), StaticStatus::equilibrium);
    for (int k = 0; k < 10; ++k) ASSERT_EQ(shared.step(1e3), StepStatus::accepted);
    const Ledger ledger = totals_of_run(shared).ledger;
    EXPECT_NEAR(ledger.balance(), alone.ledger().balance(), 1e-9 * std::abs(ledger.gravity));
    shared.gather_results();
    if (own.own() != 0) return;
    EXPECT_LT(distance(alone.states(), shared.states()), 1e-9);
    // Supported blocks stay at rest, the flying one falls g t^2 / 2.
    EXPECT_LT(shared.states()[2].velocity.norm(), 1e-7);
    EXPECT_NEAR(test_support::place_of(shared, 4, {3.5, 0.5, 3.5}).z(), 3.5 - 0.5 * gravity * 0.1 * 0.1,
                1e-6);
  });
}

TEST(SharedStatics, WithoutStaticStateBlocksStartAsPlaced) {
  Placed scene = on_slope(0.3, {});
  scene.blocks.push_back(
      block_of("upper", test_support::tilted_box({-0.5, -0.5, 1}, {0.5, 0.5, 2}, 30.0), brick, 1));
  run_on_threads(2, [&](Ranks& own) {
    Simulation shared = simulation_on(own, scene, {0, 0, 1});
    ASSERT_EQ(shared.start_from_statics(), StaticStatus::moving);
    EXPECT_EQ(shared.steps(), 0);
    for (const int k : {0, 2})
      EXPECT_EQ(
          (shared.states()[at(k)].position - BlockModel(scene.blocks[at(k)]).initial_state().position).norm(),
          0.0);
    EXPECT_EQ(shared.step(1e3), StepStatus::accepted);
  });
}

TEST(SharedStatics, AnAnalysisGoesOnFromItsSnapshotOnAnyNumberOfRanks) {
  const Placed scene = wall(4, 6);
  const Verdict alone = run_alone(scene, analyse);
  const SimulationSnapshot whole = run_shared(scene, owners_of(scene, 2), 2, [](Simulation& simulation) {
    for (int k = 0; k < 4; ++k) EXPECT_EQ(simulation.static_step(1.0), StaticStatus::balancing);
    simulation.gather_results();
    return simulation.snapshot();
  });
  const auto go_on = [&](Simulation& simulation) {
    simulation.restore(whole);
    Verdict verdict = analyse(simulation);
    EXPECT_EQ(verdict.status, StaticStatus::equilibrium);
    return verdict;
  };
  const Verdict one = run_alone(scene, go_on);
  EXPECT_EQ(one.steps, alone.steps);
  EXPECT_LT(distance(alone.states, one.states), 1e-9);
  const Verdict shared = run_shared(scene, owners_of(scene, 4), 4, go_on);
  EXPECT_LT(distance(alone.states, shared.states), 1e-9);
}

}  // namespace
}  // namespace ashlar::shared_statics_test
