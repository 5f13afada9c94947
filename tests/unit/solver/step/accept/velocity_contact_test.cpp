// Steps with multipliers end with what pushes at rest, whatever part of the step it was in contact.
#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "support/simulations.hpp"

namespace ashlar::velocity_contact_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::same_law;

SimulationSettings augmented(double time_step, Integrator integrator = Integrator::dda) {
  SimulationSettings settings;
  settings.integrator = integrator;
  settings.time_step = time_step;
  settings.augmented = true;
  settings.multipliers.penetration_tolerance = 1e-6;
  return settings;
}

Vector3 velocity_of(const Simulation& simulation, std::size_t block, const Vector3& point) {
  return simulation.states()[block].velocity.transpose() * simulation.blocks()[block].basis().values(point);
}

BlockModel cube(const Vector3& low, int order = 1) {
  return BlockModel(
      block_of("cube", Polyhedron(make_box(low, low + Vector3::Ones())), {2500, 1e9, 0.2}, order));
}

/// A cube on a base whose faces below and above follow a history.
Simulation on_moving_base(const SupportHistory& history, const Vector3& velocity, double friction,
                          const SimulationSettings& settings) {
  BlockDefinition base = block_of("base", Polyhedron(make_box({-4, -4, -1}, {5, 5, 0})), {2500, 1e9, 0.2}, 1);
  for (const double z : {-1.0, 0.0})
    base.supports.push_back({Plane{{0, 0, z}, Vector3::UnitZ()}, {true, true, true}, history});
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(base));
  blocks.push_back(cube({0, 0, 0}));
  return {std::move(blocks),
          {{}, {velocity, {0, 0, 0}}},
          same_law({2e10, 1e10, friction, 0.0, 0.0, true}),
          settings};
}

/// Two cubes that meet at 2 m/s. @return velocity at which their faces part after the step in which they meet
double rebound(double share_of_step, int order, double stop_stiffness) {
  constexpr double speed = 2.0, time_step = 1e-3;
  SimulationSettings settings = augmented(time_step);
  settings.gravity.setZero();
  settings.multipliers.stop_stiffness = stop_stiffness;
  const double gap = share_of_step * speed * time_step;
  std::vector<BlockModel> blocks;
  blocks.push_back(cube({0, 0, 0}, order));
  blocks.push_back(cube({1 + gap, 0, 0}, order));
  Simulation simulation(std::move(blocks), {{{speed, 0, 0}, {0, 0, 0}}, {}},
                        same_law({2e10, 1e10, 0.5, 0.0, 0.0, true}), settings);
  const Vector3 momentum = simulation.momentum();
  const double energy = 0.5 * 2500.0 * speed * speed;
  EXPECT_EQ(simulation.step(1.0), StepStatus::accepted);
  EXPECT_GT(simulation.report().locked + simulation.report().sliding, 0);
  EXPECT_LT((simulation.momentum() - momentum).norm(), 1e-12 * momentum.norm());
  EXPECT_LT(simulation.ledger().kinetic + simulation.ledger().elastic, energy);
  // The residual is at most its share of the largest force, m v/dt, which acts over less than v dt.
  EXPECT_LT(std::abs(simulation.ledger().residual),
            settings.iteration.residual_tolerance * 2500.0 * speed * speed);
  double largest = 0.0;
  for (const double y : {0.0, 0.5, 1.0}) {
    const double parting =
        (velocity_of(simulation, 1, {1 + gap, y, 0.5}) - velocity_of(simulation, 0, {1, y, 0.5})).x();
    if (std::abs(parting) > std::abs(largest)) largest = parting;
  }
  return largest / speed;
}

TEST(VelocityContact, WhatMeetsStopsWhereItMeetsWheneverInTheStep) {
  for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    for (const int order : {1, 2})
      EXPECT_NEAR(rebound(share, order, SimulationSettings{}.multipliers.stop_stiffness), 0.0, 1e-2) << share;
    // The step alone: D = -share v dt, v' = 2 D/dt + v away from each other.
    EXPECT_NEAR(rebound(share, 1, 0.0), 1.0 - 2.0 * share, 1e-2) << share;
  }
}

TEST(VelocityContact, ForcesGiveEachBlockItsMomentum) {
  // A cube drops on another one on a plate; the upper one slides.
  for (const Integrator integrator :
       {Integrator::dda, Integrator::average_acceleration, Integrator::generalized_alpha}) {
    SimulationSettings settings = augmented(1e-3, integrator);
    std::vector<BlockModel> blocks;
    blocks.emplace_back(fixed_box({-1, -1, -1}, {2, 2, 0}));
    blocks.push_back(cube({0, 0, 0}));
    blocks.push_back(cube({0.2, 0.1, 1.001}, 2));
    Simulation simulation(std::move(blocks), {{}, {}, {{0.5, 0, -0.5}, {0, 0, 0}}},
                          same_law({2e10, 1e10, 0.3, 0.0, 0.0, true}), settings);
    double largest = 0.0;
    for (int step = 0; step < 30; ++step) {
      std::array<Vector3, 3> before;
      for (std::size_t k = 1; k < 3; ++k) before[k] = simulation.blocks()[k].momentum(simulation.states()[k]);
      ASSERT_EQ(simulation.step(1.0), StepStatus::accepted);
      std::array<Vector3, 3> impulse;
      impulse.fill(simulation.report().step * 2500.0 * Vector3(0, 0, -9.81));
      for (const PairRecord& record : simulation.contacts()) {
        const Vector3 on_a = simulation.report().step * force_on_a(record);
        impulse[static_cast<std::size_t>(record.a)] += on_a;
        impulse[static_cast<std::size_t>(record.b)] -= on_a;
      }
      for (std::size_t k = 1; k < 3; ++k) {
        const Vector3 gained = simulation.blocks()[k].momentum(simulation.states()[k]) - before[k];
        largest = std::max(largest, gained.norm());
        EXPECT_LT((gained - impulse[k]).norm(), 1e-9 * 2500.0) << step;
      }
    }
    EXPECT_GT(largest, 250.0);  // of 1250 kg m/s that it comes with
  }
}

TEST(VelocityContact, ASupportThatMovesPushesAndWorks) {
  // The step alone would end at twice the speed.
  constexpr double speed = 1.0, time_step = 1e-2;
  const SupportHistory up{{0.0, 10.0}, {Vector3::Zero(), {0, 0, 10.0 * speed}}};
  Simulation simulation = on_moving_base(up, Vector3::Zero(), 0.5, augmented(time_step));
  EXPECT_EQ(simulation.step(1.0), StepStatus::accepted);
  for (const double x : {0.0, 1.0})
    EXPECT_NEAR(velocity_of(simulation, 1, {x, 0.5, 0}).z(), speed, 2e-2 * speed);
  ASSERT_TRUE(test_support::run_until(simulation, 0.2));
  EXPECT_LT(simulation.largest_step_residual(), 1e-11 * simulation.largest_energy());
}

TEST(VelocityContact, FrictionIsThatOfAllThatBears) {
  // Steady impulses would bear a quarter of the weight, without friction, where generalized-alpha's velocity
  // of what stands still were taken for motion.
  constexpr double speed = 1.0, friction = 0.3, time = 0.2;
  for (const Integrator integrator :
       {Integrator::dda, Integrator::average_acceleration, Integrator::generalized_alpha}) {
    SimulationSettings settings = augmented(1e-3, integrator);
    settings.spectral_radius = 0.0;
    std::vector<BlockModel> blocks;
    blocks.emplace_back(fixed_box({-1, -1, -1}, {2, 2, 0}));
    blocks.push_back(cube({0, 0, 0}));
    Simulation simulation(std::move(blocks), {{}, {{speed, 0, 0}, {0, 0, 0}}},
                          same_law({2e10, 1e10, friction, 0.0, 0.0, true}), settings);
    ASSERT_TRUE(test_support::run_until(simulation, time));
    const double travel = test_support::place_of(simulation, 1, {0.5, 0.5, 0.5}).x() - 0.5;
    EXPECT_NEAR(travel, speed * time - 0.5 * friction * 9.81 * time * time, 2e-3 * speed * time);
  }
}

/// A cube on a base that moves from rest with an acceleration, its velocity another one in each step.
/// @return velocity of the cube's centroid
Vector3 carried(const Vector3& acceleration, const Vector3& velocity, double friction, Integrator integrator,
                double time) {
  constexpr double time_step = 1e-3;
  SupportHistory history;
  for (double t = 0.0; t < time + 1.5 * time_step; t += time_step) {
    history.times.push_back(t);
    history.values.emplace_back(0.5 * t * t * acceleration);
  }
  Simulation simulation = on_moving_base(history, velocity, friction, augmented(time_step, integrator));
  EXPECT_TRUE(test_support::run_until(simulation, time));
  return velocity_of(simulation, 1, {0.5, 0.5, 0.5});
}

TEST(VelocityContact, FrictionOnSupportsThatSpeedUpIsThatOfAllThatBears) {
  constexpr double g = 9.81, time = 0.1, friction = 0.2, speed = 1.0;
  for (const Integrator integrator :
       {Integrator::dda, Integrator::average_acceleration, Integrator::generalized_alpha}) {
    for (const double up : {-5.0, 5.0}) {
      const double lost = friction * (g + up) * time;
      EXPECT_NEAR(speed - carried({0, 0, up}, {speed, 0, 0}, friction, integrator, time).x(), lost,
                  3e-2 * lost)
          << up;
    }
  }
}

/// A tied beam that is let go on two bases. @return second differences of its bearing force by the first
/// ones, sums over 80 steps: 2 sin(pi/n) of what swings in n steps, 2 of what alternates
double roughness_of_bearing_force(Integrator integrator, double stop_stiffness) {
  SimulationSettings settings = augmented(5e-4, integrator);
  settings.multipliers.penetration_tolerance = 2e-6;
  settings.multipliers.stop_stiffness = stop_stiffness;
  std::vector<BlockModel> blocks;
  for (const double x : {0.0, 0.55, 1.1})
    blocks.emplace_back(
        block_of("beam", Polyhedron(make_box({x, -0.34, 0}, {x + 0.55, 0.34, 0.4})), {2500, 6.5e7, 0.2}, 1));
  blocks.emplace_back(fixed_box({-0.14, -1, -0.4}, {0.14, 1, 0}));
  blocks.emplace_back(fixed_box({1.51, -1, -0.4}, {1.79, 1, 0}));
  Simulation simulation(std::move(blocks), std::vector<InitialMotion>(5),
                        same_law({4e8, 2e8, 0.1, 0.0, 0.0, true}), settings, {{0, 1, 1e13}, {1, 2, 1e13}});
  EXPECT_TRUE(simulation.system().are_tied(0, 1) && simulation.system().are_tied(1, 2));
  std::vector<double> forces;
  for (int step = 0; step < 80; ++step) {
    EXPECT_EQ(simulation.step(1.0), StepStatus::accepted);
    double sum = 0.0;
    for (const PairRecord& record : simulation.contacts())
      for (const PointResponse& response : record.responses) sum += response.force[0];
    forces.push_back(sum);
  }
  double first = 0.0, second = 0.0;
  for (std::size_t k = 1; k + 1 < forces.size(); ++k) {
    first += std::abs(forces[k + 1] - forces[k]);
    second += std::abs(forces[k + 1] - 2.0 * forces[k] + forces[k - 1]);
  }
  return second / first;
}

TEST(VelocityContact, BearingForcesSwingAsTheBeamDoes) {
  // The beam swings in ten steps and more.
  for (const Integrator integrator :
       {Integrator::dda, Integrator::average_acceleration, Integrator::generalized_alpha}) {
    const double stopped =
        roughness_of_bearing_force(integrator, SimulationSettings{}.multipliers.stop_stiffness);
    EXPECT_LT(stopped, 2.0 * std::sin(std::numbers::pi / 10));
    EXPECT_GT(roughness_of_bearing_force(integrator, 0.0), 2.0 * std::sin(std::numbers::pi / 6));
  }
}

/// A block 0.5 m wide and 2 m high is let go tilted by 6 degrees. @return its largest tilts, one to each
/// side, after the first and the second impact, rad
std::array<double, 2> rocking_tilts(Integrator integrator) {
  const SimulationSettings settings = augmented(5e-4, integrator);
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-3, -2, -1}, {3, 2, 0}));
  const Polyhedron tilted = test_support::tilted_box({-0.5, -0.25, 0}, {0, 0.25, 2}, -6.0);
  blocks.emplace_back(block_of("block", tilted, {2500, 1e12, 0.2}, 1));
  Simulation simulation(std::move(blocks), {{}, {}}, same_law({2e11, 1e11, 1.0, 0.0, 0.0, true}), settings);
  const double angle = 6.0 * std::numbers::pi / 180.0;
  const Vector3 up(std::sin(angle), 0, std::cos(angle));
  std::array<double, 2> largest = {0.0, 0.0};
  while (!simulation.reached(1.7)) {
    EXPECT_EQ(simulation.step(1.7), StepStatus::accepted);
    const Vector3 axis =
        test_support::place_of(simulation, 1, 2.0 * up) - test_support::place_of(simulation, 1, {0, 0, 0});
    const double tilt = std::atan2(axis.x(), axis.z());
    largest[0] = std::max(largest[0], -tilt);
    if (simulation.time() > 1.0) largest[1] = std::max(largest[1], tilt);
  }
  return largest;
}

TEST(VelocityContact, ARockingBlockLosesWhatAnInelasticImpactTakes) {
  // Housner (1963): about an edge a block has w'^2 = 2 p^2 (cos(a - tilt) - cos(a)), p^2 = 3 g/4R, tan(a) =
  // b/h; at an impact it keeps 1 - 3/2 sin(a)^2 of its w.
  const double slope = std::atan2(0.25, 1.0);
  const double kept = 1.0 - 1.5 * std::pow(std::sin(slope), 2);
  double tilt = 6.0 * std::numbers::pi / 180.0;
  std::array<double, 2> expected = {};
  for (double& next : expected) {
    const double fall = std::cos(slope - tilt) - std::cos(slope);
    tilt = next = slope - std::acos(std::cos(slope) + kept * kept * fall);
  }
  for (const Integrator integrator :
       {Integrator::dda, Integrator::average_acceleration, Integrator::generalized_alpha}) {
    const std::array<double, 2> found = rocking_tilts(integrator);
    for (const std::size_t k : {0U, 1U}) EXPECT_NEAR(found[k] / expected[k], 1.0, 0.01) << k;
  }
}

TEST(VelocityContact, FrictionThatIsDueAndThatActedIsCounted) {
  // 0.2 s on fixed ground, from 3 m/s down to 2: an impulse of m g t presses, half of it rubs.
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-4, -4, -1}, {8, 5, 0}));
  blocks.push_back(cube({0, 0, 0}));
  Simulation simulation(std::move(blocks), {{}, {{3, 0, 0}, {0, 0, 0}}},
                        same_law({2e10, 1e10, 0.5, 0.0, 0.0, true}), augmented(1e-3));
  ASSERT_TRUE(test_support::run_until(simulation, 0.2));
  const double impulse = 0.5 * 2500.0 * 9.81 * 0.2;
  EXPECT_NEAR(simulation.sliding_friction().due, impulse, 0.01 * impulse);
  EXPECT_NEAR(simulation.sliding_friction().acted, impulse, 0.01 * impulse);
  EXPECT_NEAR(velocity_of(simulation, 1, {0.5, 0.5, 0.5}).x(), 3.0 - 0.5 * 9.81 * 0.2, 0.01);
}

}  // namespace
}  // namespace ashlar::velocity_contact_test
