#include "solver/step/detect/sleeping_islands.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar::sleeping_islands_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::place_of;
using test_support::run_until;
using test_support::same_law;
using test_support::tilted_box;

const Material stone{2500, 1e9, 0.2};
constexpr double g = 9.81;

SimulationSettings settings_of(double step) {
  SimulationSettings settings;
  settings.time_step = step;
  return settings;
}

Simulation simulation_of(std::vector<BlockDefinition> definitions, const std::vector<InitialMotion>& motions,
                         const JointLaw& law, const SimulationSettings& settings) {
  std::vector<BlockModel> blocks;
  for (BlockDefinition& definition : definitions) blocks.emplace_back(std::move(definition));
  return Simulation(std::move(blocks), motions, same_law(law), settings);
}

/// A cube of 1 m at rest on a floor, 1 m under another one that hangs `above` it.
Simulation cubes(double above, const SimulationSettings& settings) {
  return simulation_of(
      {fixed_box({-5, -5, -1}, {5, 5, 0}),
       block_of("low", Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 1})), stone, 1),
       block_of("high", Polyhedron(make_box({-0.5, -0.5, 1 + above}, {0.5, 0.5, 2 + above})), stone, 1)},
      {{}, {}, {}}, {1e9, 1e9, 0.5, 0.0, 0.0, true}, settings);
}

double height(const Simulation& simulation, int block) {
  return place_of(simulation, block, simulation.blocks()[static_cast<std::size_t>(block)].basis().centroid())
      .z();
}

TEST(SleepingIslands, AStackSleepsWhereItCameToRest) {
  Simulation simulation = cubes(0.0, settings_of(2e-3));
  ASSERT_TRUE(run_until(simulation, 1.0));
  EXPECT_EQ(simulation.counts().islands_put_to_sleep, 1U);
  const Vector3 place = place_of(simulation, 2, {0, 0, 2});
  ASSERT_TRUE(run_until(simulation, 1.2));
  EXPECT_EQ(place_of(simulation, 2, {0, 0, 2}), place);
  // The springs below carry both weights, those between one: forces last while blocks sleep.
  double below = 0.0;
  double between = 0.0;
  for (const PairRecord& record : simulation.contacts())
    (record.a == 0 ? below : between) += std::abs(force_on_a(record).z());
  EXPECT_NEAR(below, 2 * 2500 * g, 1.0);
  EXPECT_NEAR(between, 2500 * g, 1.0);
  EXPECT_LT(std::abs(simulation.ledger().residual), 1e-9 * simulation.ledger().elastic + 1e-7);
}

TEST(SleepingIslands, AKeyTurnsItOff) {
  SimulationSettings settings = settings_of(2e-3);
  settings.rest.sleeps = false;
  Simulation simulation = cubes(0.0, settings);
  ASSERT_TRUE(run_until(simulation, 1.0));
  EXPECT_EQ(simulation.counts().islands_put_to_sleep, 0U);
}

// The upper cube falls 1 m: it touches after sqrt(2 h / g) = 0.45 s, long after the lower one sleeps.
TEST(SleepingIslands, ABlockThatFallsOnAnotherOneWakesIt) {
  SimulationSettings settings = settings_of(2e-3);
  Simulation sleeping = cubes(1.0, settings);
  settings.rest.sleeps = false;
  Simulation awake = cubes(1.0, settings);
  const double touch = std::sqrt(2.0 / g);
  ASSERT_TRUE(run_until(sleeping, 0.9 * touch));
  ASSERT_TRUE(run_until(awake, 0.9 * touch));
  EXPECT_EQ(sleeping.counts().islands_put_to_sleep, 1U);
  ASSERT_TRUE(run_until(sleeping, touch + 0.05));
  ASSERT_TRUE(run_until(awake, touch + 0.05));
  // The lower cube is pressed as if it had never slept: static compression under both is of the order of 1e-4 m.
  EXPECT_NEAR(height(sleeping, 1), height(awake, 1), 1e-7);
  EXPECT_NEAR(height(sleeping, 2), height(awake, 2), 1e-6);
  ASSERT_TRUE(run_until(sleeping, 3.0));
  EXPECT_EQ(sleeping.counts().islands_put_to_sleep, 2U);
  // Both weights on the floor, at rest.
  double below = 0.0;
  for (const PairRecord& record : sleeping.contacts())
    if (record.a == 0) below += std::abs(force_on_a(record).z());
  EXPECT_NEAR(below, 2 * 2500 * g, 1.0);
}

/// A cube that a load along x pushes from 1 s on. @return how far, at 1.5 s
double pushed_by_a_late_load(const SimulationSettings& settings, std::uint64_t& slept) {
  BlockDefinition cube = block_of("cube", Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 1})), stone, 1);
  Load push;
  push.where = Plane{{-0.5, 0, 0}, {-1, 0, 0}};
  push.traction = false;
  push.vector = {2500.0 * 0.7 * g, 0, 0};
  push.history = {{1.0, 1.0 + 1e-9}, {0.0, 1.0}};
  cube.loads.push_back(push);
  Simulation simulation = simulation_of({fixed_box({-5, -5, -1}, {5, 5, 0}), std::move(cube)}, {{}, {}},
                                        {1e10, 1e10, 0.5, 0.0, 0.0, true}, settings);
  EXPECT_TRUE(run_until(simulation, 1.0));
  slept = simulation.counts().islands_put_to_sleep;
  EXPECT_TRUE(run_until(simulation, 1.5));
  return place_of(simulation, 1, {0, 0, 0.5}).x();
}

// The load is larger than friction: a = (F - mu m g) / m from 1 s on. A cube that is pushed shears and rocks a
// little, too.
TEST(SleepingIslands, ALoadThatBeginsWakesABlock) {
  SimulationSettings settings = settings_of(1e-3);
  std::uint64_t slept = 0;
  const double with_sleep = pushed_by_a_late_load(settings, slept);
  EXPECT_EQ(slept, 1U);
  settings.rest.sleeps = false;
  EXPECT_NEAR(with_sleep, pushed_by_a_late_load(settings, slept), 1e-7);
  EXPECT_EQ(slept, 0U);
  EXPECT_NEAR(with_sleep, 0.5 * 0.2 * g * 0.25, 0.02 * 0.5 * 0.2 * g * 0.25);
}

// At the top of its flight a block is as slow as one at rest: in 1 ms it moves by g t^2 / 2 = 5e-6 m.
TEST(SleepingIslands, ABlockAtTheTopOfItsFlightDoesNotSleep) {
  InitialMotion up;
  up.velocity = {0, 0, 0.01};
  Simulation simulation =
      simulation_of({block_of("cube", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), stone, 1)}, {up},
                    {1e9, 1e9, 0.5, 0.0, 0.0, true}, settings_of(1e-5));
  ASSERT_TRUE(run_until(simulation, 5e-3));
  EXPECT_EQ(simulation.counts().islands_put_to_sleep, 0U);
  EXPECT_NEAR(height(simulation, 0) - 0.5, 0.01 * 5e-3 - 0.5 * g * 25e-6, 1e-9);
}

// Friction is 1e-4 below the demand of the slope: the motion of a = g (sin - mu cos) begins far below the limit of rest.
TEST(SleepingIslands, ABlockThatSetsOffSlowlyDoesNotSleep) {
  constexpr double degrees = 30.0;
  const double angle = degrees * std::numbers::pi / 180.0;
  const double friction = std::tan(angle) * (1.0 - 1e-3);
  BlockDefinition slope = block_of("slope", tilted_box({-5, -5, -1}, {5, 5, 0}, degrees), stone, 1);
  slope.fixed = true;
  Simulation simulation = simulation_of(
      {std::move(slope), block_of("cube", tilted_box({-0.5, -0.5, 0}, {0.5, 0.5, 0.2}, degrees), stone, 1)},
      {{}, {}}, {1e10, 1e10, friction, 0.0, 0.0, true}, settings_of(2e-3));
  ASSERT_TRUE(run_until(simulation, 0.5));
  const Vector3 start = place_of(simulation, 1, {0, 0, 0});
  const double speed = simulation.blocks()[1].momentum(simulation.states()[1]).norm() /
                       (2500 * simulation.blocks()[1].basis().volume());
  ASSERT_TRUE(run_until(simulation, 1.5));
  EXPECT_EQ(simulation.counts().islands_put_to_sleep, 0U);
  const double acceleration = g * (std::sin(angle) - friction * std::cos(angle));
  EXPECT_NEAR((place_of(simulation, 1, {0, 0, 0}) - start).norm(), speed + 0.5 * acceleration,
              0.02 * (speed + 0.5 * acceleration));
}

/// Stiff cubes of 1 m that fall 2 cm onto each other at 1/240 s: waves through them take 1e-3 s, far less than a step.
Simulation dropped_column(SimulationSettings settings) {
  const Material stiff{2600, 1e10, 0.2};
  std::vector<BlockDefinition> column = {fixed_box({-5, -5, -1}, {5, 5, 0})};
  for (int k = 0; k < 6; ++k) {
    const double low = k + 0.02 * (k + 1);
    column.push_back(
        block_of("cube", Polyhedron(make_box({-0.5, -0.5, low}, {0.5, 0.5, low + 1})), stiff, 1));
  }
  return simulation_of(std::move(column), std::vector<InitialMotion>(7), {1e10, 1e10, 0.5, 0.0, 0.0, true},
                       settings);
}

// Under dda what the step does not resolve rings on, alternating from step to step, for seconds: it is no motion.
TEST(SleepingIslands, AColumnThatRingsFasterThanTheStepSleeps) {
  SimulationSettings settings = settings_of(1.0 / 240.0);
  Simulation sleeping = dropped_column(settings);
  ASSERT_TRUE(run_until(sleeping, 1.5));
  EXPECT_EQ(sleeping.counts().islands_put_to_sleep, 1U);
  settings.rest.sleeps = false;
  Simulation awake = dropped_column(settings);
  ASSERT_TRUE(run_until(awake, 1.5));
  EXPECT_GT(awake.ledger().kinetic, 0.0);
  // It sleeps where the others ring about: within what they ring by.
  EXPECT_NEAR(height(sleeping, 6), height(awake, 6), 2e-5);
  EXPECT_LT(std::abs(sleeping.ledger().residual), 1e-9 * sleeping.ledger().elastic + 1e-4);
}

// Without dissipation nothing comes to rest.
TEST(SleepingIslands, NothingSleepsUnderAverageAcceleration) {
  SimulationSettings settings = settings_of(1.0 / 240.0);
  settings.integrator = Integrator::average_acceleration;
  Simulation simulation = dropped_column(settings);
  ASSERT_TRUE(run_until(simulation, 1.5));
  EXPECT_EQ(simulation.counts().islands_put_to_sleep, 0U);
}

TEST(SleepingIslands, ARunGoesOnFromSleepAsIfItHadNotStopped) {
  Simulation whole = cubes(1.0, settings_of(2e-3));
  ASSERT_TRUE(run_until(whole, 0.4));
  ASSERT_EQ(whole.counts().islands_put_to_sleep, 1U);
  Simulation resumed = cubes(1.0, settings_of(2e-3));
  resumed.restore(snapshot_from_bytes(to_bytes(whole.snapshot())));
  ASSERT_TRUE(run_until(whole, 0.6));
  ASSERT_TRUE(run_until(resumed, 0.6));
  EXPECT_EQ(whole.states()[1].position, resumed.states()[1].position);
  EXPECT_EQ(whole.states()[2].position, resumed.states()[2].position);
  EXPECT_EQ(whole.ledger().numerical, resumed.ledger().numerical);
}

}  // namespace
}  // namespace ashlar::sleeping_islands_test
