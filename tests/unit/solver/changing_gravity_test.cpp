// Runs under gravity that has a history: motion and work by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar::changing_gravity_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::place_of;
using test_support::run_until;
using test_support::same_law;

// g = g0 + k t with g0 = [0, 0, -10], k = [0, 2, 4] until t = 1, then constant.
const GravityHistory ramp{{0.0, 1.0}, {{0, 0, -10}, {0, 2, -6}}};
const Vector3 start(0, 0, -10), rate(0, 2, 4), end(0, 2, -6);

/// A cube of 2000 kg far from the origin that falls freely.
Simulation falling(Integrator integrator) {
  SimulationSettings settings;
  settings.integrator = integrator;
  settings.time_step = 0.1;
  settings.gravity_history = ramp;
  settings.gravity = {1e3, 1e3, 1e3};  // not asked for
  std::vector<BlockModel> blocks;
  blocks.emplace_back(
      block_of("cube", Polyhedron(make_box({100, 0, 0}, {101, 1, 1})), {2000.0, 1e9, 0.2}, 2));
  return {std::move(blocks), {{}}, same_law({}), settings};
}

constexpr double mass = 2000.0;

TEST(ChangingGravity, FreeFallOfAverageAccelerationTakesTheMeanOfAStep) {
  Simulation simulation = falling(Integrator::average_acceleration);
  ASSERT_TRUE(run_until(simulation, 1.0));
  // v = g0 t + k t^2 / 2 at the steps; their trapezoids add k dt^2 t / 12 to x.
  const Vector3 velocity = start + 0.5 * rate;
  const Vector3 travel = 0.5 * start + (1.0 / 6.0 + 0.01 / 12.0) * rate;
  const Vector3 corner(100, 0, 0);
  EXPECT_NEAR((simulation.momentum() - mass * velocity).norm(), 0.0, 1e-8);
  EXPECT_NEAR((place_of(simulation, 0, corner) - corner - travel).norm(), 0.0, 1e-11);
  ASSERT_TRUE(run_until(simulation, 3.0));
  EXPECT_NEAR((simulation.momentum() - mass * (velocity + 2.0 * end)).norm(), 0.0, 1e-8);
}

TEST(ChangingGravity, FreeFallOfDdaTakesTheEndOfAStep) {
  Simulation simulation = falling(Integrator::dda);
  ASSERT_TRUE(run_until(simulation, 1.0));
  // v_n = g0 n dt + k dt^2 n (n + 1) / 2 and x = dt (v_0/2 + v_1 + ... + v_N/2), N = 10, dt = 0.1.
  const Vector3 velocity = start + 0.55 * rate;
  const Vector3 travel = 0.55 * start + 0.22 * rate - 0.05 * velocity;
  const Vector3 corner(100, 0, 0);
  EXPECT_NEAR((simulation.momentum() - mass * velocity).norm(), 0.0, 1e-8);
  EXPECT_NEAR((place_of(simulation, 0, corner) - corner - travel).norm(), 0.0, 1e-11);
}

TEST(ChangingGravity, ItsWorkIsAppliedAndHasNoPotential) {
  for (const Integrator integrator : {Integrator::dda, Integrator::average_acceleration}) {
    Simulation simulation = falling(integrator);
    ASSERT_TRUE(run_until(simulation, 2.0));
    const Ledger& ledger = simulation.ledger();
    const double kinetic = 0.5 * simulation.momentum().squaredNorm() / mass;
    EXPECT_EQ(ledger.gravity, 0.0);
    EXPECT_NEAR(ledger.kinetic / kinetic, 1.0, 1e-12);
    // The sum over steps of m g . D with D = dt (v + v')/2 and dt g = v' - v.
    EXPECT_NEAR(ledger.applied / kinetic, 1.0, 1e-10);
    EXPECT_LT(std::abs(ledger.residual), 1e-10 * kinetic);
  }
}

TEST(ChangingGravity, BalanceOfGeneralizedAlphaIsClosed) {
  Simulation simulation = falling(Integrator::generalized_alpha);
  ASSERT_TRUE(run_until(simulation, 2.0));
  const Ledger& ledger = simulation.ledger();
  EXPECT_EQ(ledger.gravity, 0.0);
  EXPECT_LT(std::abs(ledger.residual), 1e-10 * ledger.kinetic);
}

TEST(ChangingGravity, GoesOnBitForBit) {
  Simulation straight = falling(Integrator::generalized_alpha);
  ASSERT_TRUE(run_until(straight, 0.5));
  const std::string bytes = to_bytes(straight.snapshot());
  ASSERT_TRUE(run_until(straight, 1.5));
  Simulation resumed = falling(Integrator::generalized_alpha);
  resumed.restore(snapshot_from_bytes(bytes));
  ASSERT_TRUE(run_until(resumed, 1.5));
  EXPECT_EQ(to_bytes(straight.snapshot()).size(), to_bytes(resumed.snapshot()).size());
  EXPECT_EQ(straight.states()[0].position, resumed.states()[0].position);
  EXPECT_EQ(straight.ledger().applied, resumed.ledger().applied);
}

TEST(ChangingGravity, ATableThatIsTiltedLetsGoWhereFrictionEnds) {
  SimulationSettings settings;
  settings.time_step = 0.1;
  // The tangent of the tilt is t.
  settings.gravity_history = {{0.0, 1.0}, {{0, 0, -10}, {10, 0, -10}}};
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-5, -5, -1}, {5, 5, 0}));
  blocks.emplace_back(
      block_of("stone", Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 0.5})), {2500.0, 1e9, 0.2}, 1));
  Simulation simulation(std::move(blocks), {{}, {}}, same_law({1e10, 1e10, 0.36, 0.0, 0.0, true}), settings);
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing) status = simulation.static_step(1.0);
  ASSERT_EQ(status, StaticStatus::moving);
  EXPECT_NEAR(simulation.time(), 0.4, 1e-12);
  ASSERT_EQ(simulation.moving_blocks().size(), 1U);
  const Vector3 acceleration = simulation.moving_blocks()[0].acceleration;
  EXPECT_NEAR(acceleration.x(), 4.0 - 0.36 * 10.0, 1e-3);
  EXPECT_NEAR(acceleration.z(), 0.0, 1e-3);
}

TEST(ChangingGravity, SettledBlocksBearThatOfTheStart) {
  const auto sag = [](const SimulationSettings& settings) {
    BlockDefinition beam =
        block_of("beam", Polyhedron(make_box({0, 0, 0}, {4, 1, 1})), {2500.0, 1e9, 0.2}, 3);
    beam.supports.push_back({Plane{{0, 0, 0}, Vector3::UnitX()}, {true, true, true}, {}});
    std::vector<BlockModel> blocks;
    blocks.emplace_back(std::move(beam));
    Simulation simulation(std::move(blocks), {{}}, same_law({}), settings);
    EXPECT_EQ(simulation.settle_supported_blocks().size(), 1U);
    return place_of(simulation, 0, {4, 0.5, 0.5});
  };
  SimulationSettings constant, changing;
  changing.gravity_history = {{0.0, 1.0}, {constant.gravity, {9.81, 0, 0}}};
  EXPECT_EQ(sag(constant), sag(changing));
}

}  // namespace
}  // namespace ashlar::changing_gravity_test
