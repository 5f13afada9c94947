// Blocks that multipliers hold apart stay out of each other, whatever turns, and gain nothing by it.
#include <gtest/gtest.h>

#include "support/simulations.hpp"

namespace ashlar {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::same_law;

constexpr double tolerance = 1e-6;  // m

const Material rock{2500, 1e9, 0.2};

SimulationSettings augmented(Integrator integrator, double time_step, SimulationSettings settings = {}) {
  settings.integrator = integrator;
  settings.time_step = time_step;
  settings.augmented = true;
  settings.penetration_tolerance = tolerance;
  return settings;
}

/// Three dominoes, the first on its way to the second: they lean on each other and rub, face on edge and edge
/// on face, by 0.005 rad a step.
Simulation dominoes(Integrator integrator, int order, SimulationSettings settings = {}) {
  std::vector<BlockModel> blocks;
  std::vector<InitialMotion> motions(4);
  blocks.emplace_back(fixed_box({-5, -5, -1}, {5, 5, 0}));
  for (const double x : {0.0, 0.8, 1.6})
    blocks.emplace_back(
        block_of("domino", Polyhedron(make_box({x, -0.5, 0}, {x + 0.2, 0.5, 2})), rock, order));
  motions[1] = {{1.5, 0, -0.1}, {0, 1.5, 0}};  // about the far lower edge
  return {std::move(blocks), motions, same_law({1e9, 5e8, 0.4, 0.0, 0.0, true}),
          augmented(integrator, 2e-3, settings)};
}

class MovedApart : public ::testing::TestWithParam<Integrator> {};

TEST_P(MovedApart, NothingIsDeeperThanTheToleranceAndNothingIsGained) {
  for (const int order : GetParam() == Integrator::dda ? std::vector{1, 2} : std::vector{1}) {
    Simulation simulation = dominoes(GetParam(), order);
    while (!simulation.reached(1.3)) {
      ASSERT_EQ(simulation.step(1.3), StepStatus::accepted);
      EXPECT_LE(simulation.report().penetration, tolerance) << order << ' ' << simulation.time();
    }
    // The last one is falling.
    EXPECT_LT(test_support::place_of(simulation, 3, {1.7, 0, 2}).z(), 1.9);
    for (const Rejection& rejection : simulation.rejections())
      EXPECT_EQ(rejection.reason, RejectionReason::passing) << rejection.time;
    EXPECT_LE(simulation.ledger().refound_gained, 1e-9 * simulation.largest_energy());
    EXPECT_LE(simulation.largest_step_residual(), 1e-9 * simulation.largest_energy());
  }
}

INSTANTIATE_TEST_SUITE_P(Every, MovedApart,
                         ::testing::Values(Integrator::dda, Integrator::average_acceleration,
                                           Integrator::generalized_alpha));

/// Largest penetration of a tall column that turns about its lower edge and takes nothing from what it turns
/// on, alone or with a cube that falls far from it.
double deepest_of_a_toppling_column(bool with_cube) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-50, -50, -1}, {50, 50, 0}));
  blocks.emplace_back(block_of("column", test_support::tilted_box({0, -0.5, 0}, {1, 0.5, 6}, 15.0), rock, 1));
  std::vector<InitialMotion> motions(2);
  const Vector3 spin(0, -0.5, 0);
  motions[1] = {
      spin.cross(Eigen::AngleAxisd(-15.0 * std::numbers::pi / 180.0, Vector3::UnitY()) * Vector3(0.5, 0, 3)),
      spin};
  if (with_cube) {
    blocks.emplace_back(block_of("cube", Polyhedron(make_box({30, 0, 0.1}, {31, 1, 1.1})), rock, 1));
    motions.push_back({{0, 0, -1}, {0, 0, 0}});
  }
  Simulation simulation(std::move(blocks), motions, same_law({1e10, 5e9, 1.0, 0.0, 0.0, true}),
                        augmented(Integrator::dda, 4e-3));
  double deepest = 0.0;
  for (int step = 0; step < 250; ++step) {
    EXPECT_EQ(simulation.step(1e9), StepStatus::accepted);
    if (step > 30) deepest = std::max(deepest, simulation.report().penetration);
  }
  EXPECT_LE(simulation.ledger().refound_gained, 1e-9 * simulation.largest_energy());
  return deepest;
}

TEST(MovedApartLent, WhatOtherContactsHaveTakenIsLent) {
  EXPECT_GT(deepest_of_a_toppling_column(false), tolerance);
  EXPECT_LE(deepest_of_a_toppling_column(true), tolerance);
}

TEST(MovedApartFailed, LeavesTheLastAcceptedState) {
  // With so few balances allowed some step fails, and the dominoes are moved apart before most.
  int failed = 0;
  for (int rounds = 1; rounds < 4; ++rounds) {
    SimulationSettings settings;
    settings.max_step_cuts = 0;
    settings.augmented_rounds = rounds;
    Simulation simulation = dominoes(Integrator::dda, 1, settings);
    while (!simulation.reached(1.3)) {
      const std::vector<BlockState> before = simulation.states();
      const double numerical = simulation.ledger().numerical;
      if (simulation.step(1.3) == StepStatus::accepted) continue;
      ++failed;
      EXPECT_FALSE(simulation.rejections().empty());
      EXPECT_EQ(simulation.ledger().numerical, numerical);
      for (std::size_t k = 0; k < before.size(); ++k) {
        EXPECT_EQ(simulation.states()[k].position, before[k].position) << rounds << ' ' << k;
        EXPECT_EQ(simulation.states()[k].velocity, before[k].velocity) << rounds << ' ' << k;
      }
      break;
    }
  }
  EXPECT_GT(failed, 0);
}

TEST(MovedApartFree, KeepsMomentumAndAngularMomentum) {
  // Three blocks that turn meet, rub and part.
  SimulationSettings settings = augmented(Integrator::dda, 1e-3);
  settings.gravity.setZero();
  std::vector<BlockModel> blocks;
  blocks.emplace_back(block_of("a", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), rock, 1));
  blocks.emplace_back(block_of("b", Polyhedron(make_box({1.3, 0.3, 0.2}, {2.0, 1.5, 2.0})), rock, 2));
  blocks.emplace_back(block_of("c", Polyhedron(make_box({2.2, 0.5, 0.5}, {3.0, 1.5, 2.2})), rock, 1));
  const std::vector<InitialMotion> motions{
      {{2, 0.3, 0}, {0.5, 1.5, 0.7}}, {{0, 0, 0}, {0.1, -0.5, 0.9}}, {{-1, 0, 0}, {0, 0, 0}}};
  Simulation simulation(std::move(blocks), motions, same_law({1e9, 5e8, 0.6, 0.0, 0.0, true}), settings);
  const Vector3 momentum = simulation.momentum();
  const Vector3 angular = simulation.angular_momentum();
  const double energy = simulation.ledger().kinetic;
  int touching = 0;
  while (!simulation.reached(1.0)) {
    ASSERT_EQ(simulation.step(1.0), StepStatus::accepted);
    EXPECT_LE(simulation.ledger().kinetic + simulation.ledger().elastic, (1.0 + 1e-12) * energy);
    EXPECT_LE(simulation.report().penetration, tolerance);
    touching += simulation.report().locked + simulation.report().sliding > 0 ? 1 : 0;
  }
  EXPECT_GT(touching, 10);
  EXPECT_LT((simulation.momentum() - momentum).norm(), 1e-11 * momentum.norm());
  EXPECT_LT((simulation.angular_momentum() - angular).norm(), 1e-10 * angular.norm());
  EXPECT_LE(simulation.largest_step_residual(), 1e-10 * simulation.largest_energy());
}

}  // namespace
}  // namespace ashlar
