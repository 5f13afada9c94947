// Contact by multipliers in simulations whose blocks several ranks share.
#include "support/shared_runs.hpp"

namespace ashlar::shared_multipliers_test {
namespace {

using test_support::block_of;
using test_support::distance;
using test_support::End;
using test_support::fixed_box;
using test_support::owners_of;
using test_support::run_alone;
using test_support::run_shared;
using test_support::Scene;

Scene with_multipliers(Scene scene) {
  scene.settings.augmented = true;
  return scene;
}

/// Boxes that fall on each other, the higher ones faster.
Scene apart_at_first(int layers, int order) {
  Scene scene = with_multipliers(test_support::pile(layers, order, 0.6, 0.38));
  for (std::size_t k = 1; k < scene.motions.size(); ++k)
    scene.motions[k].velocity = {0.0, 0.0, -0.8 * static_cast<double>((k - 1) / 5)};
  return scene;
}

/// One rank after the other.
std::vector<int> in_turn(const Scene& scene, int ranks) {
  std::vector<int> owners;
  for (std::size_t k = 0; k < scene.blocks.size(); ++k) owners.push_back(static_cast<int>(k) % ranks);
  return owners;
}

TEST(SharedMultipliers, OneRankHasTheBitsOfNone) {
  const Scene scene = apart_at_first(3, 1);
  const End alone = run_alone(scene, 100);
  const End shared = run_shared(scene, owners_of(scene, 1), 1, 100);
  EXPECT_TRUE(test_support::same_bits(alone, shared));
}

TEST(SharedMultipliers, AWallStandsAlikeOnAnyNumberOfRanks) {
  const Scene scene = with_multipliers(test_support::wall(6, 8));
  const End alone = run_alone(scene, 60);
  for (const int ranks : {2, 4}) {
    const End shared = run_shared(scene, owners_of(scene, ranks), ranks, 60);
    EXPECT_LT(distance(alone, shared), 1e-9);
    EXPECT_NEAR(alone.totals.ledger.balance(), shared.totals.ledger.balance(),
                1e-9 * std::abs(alone.totals.ledger.gravity));
    EXPECT_EQ(alone.contacts.size(), shared.contacts.size());
  }
}

/// Impacts and friction amplify rounding errors: after 95 steps those of 1e-16 m have become 1e-10 m, on one rank too.
TEST(SharedMultipliers, APileFallsAlikeOnAnyNumberOfRanks) {
  const Scene scene = apart_at_first(4, 1);
  const End alone = run_alone(scene, 95);
  ASSERT_GT(alone.totals.ledger.friction, 1.0);
  for (const int ranks : {2, 4}) {
    const End shared = run_shared(scene, in_turn(scene, ranks), ranks, 95);
    EXPECT_LT(distance(alone, shared), 1e-8);
    EXPECT_LT(shared.largest_step_residual, 1e-9 * shared.totals.ledger.kinetic);
    EXPECT_NEAR(alone.totals.ledger.friction, shared.totals.ledger.friction,
                1e-6 * alone.totals.ledger.friction);
    EXPECT_EQ(alone.contacts.size(), shared.contacts.size());
  }
}

/// Blocks without gravity that meet in pairs and turn: their momenta stay those of the start.
Scene meeting_blocks() {
  Scene scene;
  scene.law = test_support::spring_joint(0.3);
  scene.settings.time_step = 1e-3;
  scene.settings.contact_distance = 2e-3;
  scene.settings.gravity = Vector3::Zero();
  scene.settings.augmented = true;
  scene.blocks.push_back(fixed_box({-1, -1, -9}, {4, 1, -8}));
  scene.motions.emplace_back();
  for (int k = 0; k < 6; ++k) {
    const Vector3 low(0.43 * k, 0.05 * (k % 2), 0.03 * k);
    scene.blocks.push_back(
        block_of("block", Polyhedron(make_box(low, low + Vector3(0.4, 0.2, 0.2))), {2000, 1e9, 0.2}, 1));
    scene.motions.push_back({{k % 2 == 0 ? 1.0 : -1.0, 0.0, 0.0}, {0.0, 0.5, 1.0 - k}});
  }
  return scene;
}

TEST(SharedMultipliers, MomentaOfBlocksOnSeveralRanksAreKept) {
  const Scene scene = meeting_blocks();
  const End start = run_alone(scene, 0);
  const End alone = run_alone(scene, 120);
  ASSERT_GT(alone.totals.ledger.numerical + alone.totals.ledger.friction, 0.01 * start.totals.ledger.kinetic);
  for (const int ranks : {2, 3}) {
    const End shared = run_shared(scene, owners_of(scene, ranks), ranks, 120);
    EXPECT_LT(distance(alone, shared), 1e-8);
    EXPECT_LT((shared.totals.momentum - start.totals.momentum).norm(), 1e-8);
    EXPECT_LT((shared.totals.angular_momentum - start.totals.angular_momentum).norm(), 1e-8);
    EXPECT_NEAR(alone.totals.ledger.kinetic, shared.totals.ledger.kinetic,
                1e-8 * start.totals.ledger.kinetic);
    EXPECT_LT(shared.largest_step_residual, 1e-9 * start.totals.ledger.kinetic);
  }
}

/// A bar of one rank that slides down the edge of a slab of another one, without friction: edges move into faces, and blocks
/// are separated between steps.
TEST(SharedMultipliers, BlocksOfTwoRanksAreSeparatedAlike) {
  Scene scene;
  scene.law = test_support::spring_joint(0.1);
  scene.settings.time_step = 2e-3;
  scene.settings.contact_distance = 2e-3;
  scene.settings.augmented = true;
  scene.settings.multipliers.penetration_tolerance = 1e-7;
  scene.blocks.push_back(fixed_box({-1, -1, -0.5}, {4, 1, 0}));
  for (int k = 0; k < 4; ++k) {
    const Vector3 low(0.35 * k, 0.0, 0.0);
    scene.blocks.push_back(
        block_of("domino", Polyhedron(make_box(low, low + Vector3(0.1, 0.3, 0.6))), {2000, 1e9, 0.2}, 1));
  }
  scene.motions.resize(scene.blocks.size());
  scene.motions[1] = {{0.8, 0.0, 0.0}, {0.0, 2.0, 0.0}};
  const End alone = run_alone(scene, 200);
  const End shared = run_shared(scene, {0, 0, 1, 1, 0}, 2, 200);
  EXPECT_LT(distance(alone, shared), 1e-6);
  EXPECT_LT(shared.largest_step_residual, 1e-8 * shared.totals.ledger.kinetic);
  EXPECT_LT(shared.totals.extremes.penetration, 1e-6);
}

TEST(SharedMultipliers, EveryIntegratorAndOrderMovesAlike) {
  for (const auto& [integrator, order] :
       {std::pair(Integrator::average_acceleration, 1), std::pair(Integrator::generalized_alpha, 1),
        std::pair(Integrator::dda, 0), std::pair(Integrator::dda, 2)}) {
    Scene scene = apart_at_first(2, order);
    scene.settings.integrator = integrator;
    const End alone = run_alone(scene, 100);
    ASSERT_GT(alone.totals.ledger.friction, 0.1);
    const End shared = run_shared(scene, in_turn(scene, 2), 2, 100);
    EXPECT_LT(distance(alone, shared), 1e-8) << static_cast<int>(integrator) << " " << order;
    EXPECT_NEAR(alone.totals.ledger.friction, shared.totals.ledger.friction,
                1e-6 * alone.totals.ledger.friction);
  }
}

}  // namespace
}  // namespace ashlar::shared_multipliers_test
