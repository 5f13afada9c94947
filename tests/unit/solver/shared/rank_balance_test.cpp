// Blocks that are shared out again in a run.
#include "solver/shared/rank_balance.hpp"

#include "solver/step/accept/snapshot.hpp"
#include "support/shared_runs.hpp"

namespace ashlar::rank_balance_test {
namespace {

using test_support::advance;
using test_support::block_of;
using test_support::distance;
using test_support::End;
using test_support::fixed_box;
using test_support::looking_each;
using test_support::owners_of;
using test_support::pile;
using test_support::run_alone;
using test_support::run_shared;
using test_support::Scene;
using test_support::spring_joint;
using test_support::wall;

/// All on the first rank.
std::vector<int> first_has_all(const Scene& scene) {
  std::vector<int> owners(scene.blocks.size(), 0);
  return owners;
}

int repartitions(const End& end) {
  return end.work[0].repartitions;
}

/// Largest weight of a rank relative to the mean, minus 1.
double imbalance(const End& end) {
  double sum = 0.0, most = 0.0;
  for (const RankWork& work : end.work) {
    sum += work.weight;
    most = std::max(most, work.weight);
  }
  return most * static_cast<double>(end.work.size()) / sum - 1.0;
}

void expect_same_run(const End& alone, const End& shared) {
  EXPECT_LT(distance(alone, shared), 1e-9);
  EXPECT_NEAR(alone.totals.ledger.balance(), shared.totals.ledger.balance(),
              1e-9 * std::abs(alone.totals.ledger.gravity));
  EXPECT_NEAR(alone.totals.ledger.contact, shared.totals.ledger.contact,
              1e-6 * std::abs(alone.totals.ledger.contact));
  EXPECT_NEAR(alone.totals.ledger.friction, shared.totals.ledger.friction,
              1e-6 * std::abs(alone.totals.ledger.friction) + 1e-9);
  EXPECT_EQ(alone.contacts.size(), shared.contacts.size());
}

TEST(RankBalance, AWallOfOneRankIsSharedOutAmongAll) {
  const Scene scene = wall(6, 8);
  const End alone = run_alone(scene, 60);
  for (const int ranks : {2, 4}) {
    const End shared = run_shared(scene, first_has_all(scene), ranks, 60, looking_each(25));
    EXPECT_EQ(repartitions(shared), 1);
    EXPECT_LT(imbalance(shared), 0.2);
    for (const RankWork& work : shared.work) EXPECT_GT(work.own, 45 / ranks / 2);
    expect_same_run(alone, shared);
    EXPECT_LT(shared.largest_step_residual, 1e-9 * std::abs(shared.totals.ledger.gravity));
  }
}

/// A pile falls onto one end of a wall of two ranks: the other rank gets blocks of the first.
TEST(RankBalance, APileThatFallsToOneSideIsBalanced) {
  Scene scene = pile(6, 1);
  for (std::size_t k = 1; k < scene.blocks.size(); ++k) scene.motions[k].velocity = {-1.5, 0.0, 0.0};
  const int base = 0;
  // The right half falls on the fixed base, the left one, of the other rank, beyond it.
  scene.blocks[base] = fixed_box({0.3, -2, -0.5}, {4, 2, 0});
  const std::vector<int> owners = owners_of(scene, 2);
  const End alone = run_alone(scene, 160);
  const End still = run_shared(scene, owners, 2, 160);
  const End shared = run_shared(scene, owners, 2, 160, looking_each(40));
  EXPECT_GT(imbalance(still), 0.2);
  EXPECT_GT(repartitions(shared), 0);
  EXPECT_LT(imbalance(shared), imbalance(still));
  expect_same_run(alone, shared);
}

TEST(RankBalance, FallingBlocksKeepTheirContactsAndRecentMotion) {
  for (const Integrator integrator : {Integrator::dda, Integrator::generalized_alpha}) {
    Scene scene = pile(4, 1);
    scene.settings.integrator = integrator;
    scene.law.damping = 0.1;
    const End alone = run_alone(scene, 110);
    const End shared = run_shared(scene, first_has_all(scene), 3, 110, looking_each(70));
    EXPECT_EQ(repartitions(shared), 1);
    EXPECT_GT(shared.contacts.size(), 10u);
    expect_same_run(alone, shared);
  }
}

TEST(RankBalance, JointsKeepWhatHasBroken) {
  Scene scene = wall(2, 4);
  scene.law.cohesion = 1e4;
  scene.law.tensile_strength = 1e3;
  for (std::size_t k = 5; k < scene.blocks.size(); ++k) scene.motions[k].velocity = {0.0, 0.0, 0.5};
  const End alone = run_alone(scene, 40);
  const End shared = run_shared(scene, first_has_all(scene), 2, 40, looking_each(20));
  const auto areas_of = [](const End& end) {
    std::array<double, 2> sums{0.0, 0.0};
    for (const RankWork& work : end.work) {
      sums[0] += work.broken_area;
      sums[1] += work.bonded_area;
    }
    return sums;
  };
  EXPECT_EQ(repartitions(shared), 1);
  EXPECT_GT(areas_of(alone)[0], 0.1);
  EXPECT_NEAR(areas_of(shared)[0], areas_of(alone)[0], 1e-8);
  EXPECT_NEAR(areas_of(shared)[1], areas_of(alone)[1], 1e-8);
  expect_same_run(alone, shared);
}

/// A stack sleeps when its blocks get other owners, and is woken by a block that falls on it.
TEST(RankBalance, SleepingBlocksGoToOtherRanks) {
  Scene scene;
  scene.law = spring_joint(0.5);
  scene.settings.time_step = 2e-3;
  scene.blocks.push_back(fixed_box({-5, -5, -1}, {5, 5, 0}));
  for (const double x : {0.0, 3.0})
    for (const double z : {0.0, 1.0})
      scene.blocks.push_back(
          block_of("cube", Polyhedron(make_box({x, 0, z}, {x + 1, 1, z + 1})), {2500, 1e9, 0.2}, 1));
  scene.blocks.push_back(
      block_of("late", Polyhedron(make_box({0.2, 0.2, 8}, {0.8, 0.8, 8.5})), {2500, 1e9, 0.2}, 1));
  scene.motions.resize(scene.blocks.size());
  const End alone = run_alone(scene, 620);
  const End shared = run_shared(scene, first_has_all(scene), 2, 620, looking_each(500));
  EXPECT_EQ(repartitions(shared), 1);
  EXPECT_GT(alone.states[2].velocity.norm(), 0.0);
  EXPECT_EQ(alone.totals.counts.sleeping_block_steps, shared.totals.counts.sleeping_block_steps);
  expect_same_run(alone, shared);
}

/// Neither a balanced run nor one whose partition would hardly change.
TEST(RankBalance, OwnersStayWithoutNeed) {
  const Scene scene = wall(2, 4);
  const std::vector<int> owners = owners_of(scene, 2);
  EXPECT_EQ(repartitions(run_shared(scene, owners, 2, 20, looking_each(5))), 0);
  const auto same = [&](Ranks&, const std::vector<PartitionBlock>&, int) { return first_has_all(scene); };
  EXPECT_EQ(repartitions(run_shared(scene, first_has_all(scene), 2, 20, looking_each(5, same))), 0);
  EXPECT_EQ(repartitions(run_shared(scene, first_has_all(scene), 2, 20)), 0);
}

/// A run that has shared its blocks out again is saved, and goes on on another number of ranks, or alone.
TEST(RankBalance, ARunGoesOnFromASnapshotAfterwards) {
  const Scene scene = pile(3, 1);
  const SimulationSnapshot saved = run_shared(
      scene, first_has_all(scene), 2,
      [](Simulation& simulation) {
        EXPECT_TRUE(advance(simulation, 100));
        EXPECT_EQ(simulation.shared_blocks()->balance.repartitions, 1);
        simulation.gather_results({false, {}, {}});
        return simulation.snapshot();
      },
      looking_each(80));
  const auto go_on = [&](Simulation& simulation) {
    simulation.restore(saved);
    EXPECT_TRUE(advance(simulation, 130));
  };
  const End end = run_shared(scene, first_has_all(scene), 3, go_on, looking_each(80));
  EXPECT_LT(distance(run_alone(scene, 130), end), 1e-9);
}

}  // namespace
}  // namespace ashlar::rank_balance_test
