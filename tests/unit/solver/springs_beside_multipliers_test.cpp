// Joints whose law has springs in a scene with multipliers move as their springs do.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "support/simulations.hpp"

namespace ashlar::springs_beside_multipliers_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::place_of;
using test_support::run_until;

constexpr double density = 2500.0;  // kg/m^3
constexpr double stiffness = 1e9;   // Pa/m, of the joint on the base
constexpr double gravity = 9.81;    // m/s^2

constexpr double penetration_tolerance = 1e-6;  // m

BlockModel cube_above(double height) {
  return BlockModel(
      block_of("cube", Polyhedron(make_box({0, 0, height}, {1, 1, height + 1})), {density, 1e9, 0.2}, 0));
}

/// Rigid cubes on each other and a base, released as the lowest touches it. The joint on the base has springs, the
/// others are left to the scene.
Simulation tower(int cubes, const JointLaw& on_base, bool augmented, double time_step) {
  SimulationSettings settings;
  settings.integrator = Integrator::average_acceleration;
  settings.time_step = time_step;
  settings.gravity = {0, 0, -gravity};
  settings.augmented = augmented;
  settings.multipliers.penetration_tolerance = penetration_tolerance;
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-1, -1, -1}, {2, 2, 0}));
  for (int k = 0; k < cubes; ++k) blocks.push_back(cube_above(k));
  const JointLaw rigid{1e11, 5e10, 0.5, 0.0, 0.0, true};
  const auto law = [=](int a, int b) { return a == 0 || b == 0 ? on_base : rigid; };
  const std::vector<InitialMotion> at_rest(blocks.size());
  return {std::move(blocks), at_rest, law, settings};
}

JointLaw springs_on_base() {
  JointLaw law{stiffness, 0.5 * stiffness, 0.5, 0.0, 0.0, true};
  law.transmission = Transmission::springs;
  return law;
}

// One mass on one spring: z = -(M g / k)(1 - cos w t), w^2 = k / M; no pair separates before the end of a period.
TEST(SpringsBesideMultipliers, ATowerOscillatesOnTheJointBelowIt) {
  const double mass = 2.0 * density;
  const double rate = std::sqrt(stiffness / mass);
  const double half = std::numbers::pi / rate;
  Simulation simulation = tower(2, springs_on_base(), true, half / 100.0);
  for (const double share : {0.5, 1.0, 1.5}) {
    ASSERT_TRUE(run_until(simulation, share * half));
    const double expected = mass * gravity / stiffness * (1.0 - std::cos(share * std::numbers::pi));
    const auto sunk = [&](int block) {
      return block - 1.0 - place_of(simulation, block, {0, 0, block - 1.0}).z();
    };
    EXPECT_NEAR(sunk(1), expected, 0.01 * mass * gravity / stiffness) << share << " of half a period";
    EXPECT_NEAR(sunk(2), sunk(1), penetration_tolerance) << share << " of half a period";
  }
  const double potential = mass * gravity * mass * gravity / stiffness;
  EXPECT_NEAR(simulation.ledger().numerical, 0.0, 0.01 * potential);
  EXPECT_NEAR(simulation.ledger().redetection_energy(), 0.0, 0.01 * potential);
}

// Without another joint, the scene's multipliers are none of its concern.
TEST(SpringsBesideMultipliers, ABlockOnAJointThatClosesMovesAsWithoutMultipliers) {
  JointLaw closing = springs_on_base();
  closing.largest_closure = 1e-4;
  Simulation alone = tower(1, closing, false, 1e-4);
  Simulation beside = tower(1, closing, true, 1e-4);
  for (int step = 1; step <= 100; ++step) {
    ASSERT_TRUE(run_until(alone, step * 1e-4));
    ASSERT_TRUE(run_until(beside, step * 1e-4));
    EXPECT_NEAR(place_of(beside, 1, {0, 0, 0}).z(), place_of(alone, 1, {0, 0, 0}).z(), 1e-12) << step;
  }
}

// Random towers: multipliers between the cubes, or springs so stiff that they close by less than the tolerance.
TEST(SpringsBesideMultipliers, RandomTowersMoveAsBySpringsAlone) {
  std::mt19937_64 random(20261201);
  const auto between = [&](double low, double high) {
    return low + (high - low) * 0x1p-53 * static_cast<double>(random() >> 11U);
  };
  for (int trial = 0; trial < 8; ++trial) {
    const int cubes = 1 + trial % 3;
    JointLaw law = springs_on_base();
    law.normal_stiffness = stiffness * between(0.1, 1.0);
    if (trial % 2 == 1) law.largest_closure = between(5.0, 20.0) * cubes * density * gravity / stiffness;
    const double mass = cubes * density;
    const double half = std::numbers::pi / std::sqrt(law.normal_stiffness / mass);
    Simulation springs = tower(cubes, law, false, half / 200.0);
    Simulation beside = tower(cubes, law, true, half / 200.0);
    for (const double share : {0.4, 0.8, 1.2}) {
      ASSERT_TRUE(run_until(springs, share * half));
      ASSERT_TRUE(run_until(beside, share * half));
      EXPECT_NEAR(place_of(beside, 1, {0, 0, 0}).z(), place_of(springs, 1, {0, 0, 0}).z(),
                  0.01 * mass * gravity / law.normal_stiffness)
          << trial << " at " << share;
    }
  }
}

// At rest under its weight, the tower stays where the spring balances it.
TEST(SpringsBesideMultipliers, ATowerThatStartsFromStaticsStaysAtRest) {
  const double mass = 2.0 * density;
  Simulation simulation = tower(2, springs_on_base(), true, 1e-3);
  ASSERT_EQ(simulation.start_from_statics(), StaticStatus::equilibrium);
  const double before = simulation.ledger().balance();
  ASSERT_TRUE(run_until(simulation, 0.1));
  EXPECT_NEAR(place_of(simulation, 2, {0, 0, 1}).z() - 1.0, -mass * gravity / stiffness,
              1e-3 * mass * gravity / stiffness);
  EXPECT_NEAR(simulation.ledger().balance(), before, 1e-6 * mass * mass * gravity * gravity / stiffness);
}

}  // namespace
}  // namespace ashlar::springs_beside_multipliers_test
