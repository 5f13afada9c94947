// Runs in which supports move: position, momentum and work that mechanics gives.
#include <gtest/gtest.h>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar::driven_support_test {
namespace {

using test_support::block_of;
using test_support::place_of;
using test_support::run_until;
using test_support::same_law;

constexpr std::array<bool, 3> all = {true, true, true};

/// A box 2 x 1 x 1 of order 1 whose two ends are held in some components, the far one with a history.
BlockDefinition bar(double density, std::array<bool, 3> components, const SupportHistory& near,
                    const SupportHistory& far) {
  BlockDefinition block = block_of("bar", Polyhedron(make_box({0, 0, 0}, {2, 1, 1})), {density, 1e9, 0.0}, 1);
  block.supports.push_back({Plane{{0, 0, 0}, Vector3::UnitX()}, components, near});
  block.supports.push_back({Plane{{2, 0, 0}, Vector3::UnitX()}, components, far});
  return block;
}

Simulation lone(BlockDefinition block, const SimulationSettings& settings) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(block));
  return {std::move(blocks), {{}}, same_law({}), settings};
}

TEST(DrivenSupport, StaticStretchDoesTheWorkOfItsLevels) {
  const double stretch = 0.01, stiffness = 1e9 * 1.0 / 2.0;
  SimulationSettings settings;
  settings.gravity.setZero();
  settings.time_step = 0.25;
  Simulation simulation =
      lone(bar(2500, all, {}, {{0.0, 1.0}, {Vector3::Zero(), {stretch, 0, 0}}}), settings);
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing) status = simulation.static_step(1.0);
  ASSERT_EQ(status, StaticStatus::equilibrium);
  EXPECT_NEAR(place_of(simulation, 0, {2, 0.5, 0.5}).x(), 2.0 + stretch, 1e-13);
  EXPECT_NEAR(place_of(simulation, 0, {1, 0.5, 0.5}).x(), 1.0 + 0.5 * stretch, 1e-13);
  const double energy = 0.5 * stiffness * stretch * stretch;
  EXPECT_NEAR(simulation.ledger().elastic / energy, 1.0, 1e-10);
  // Four levels, each with the force at its end: k d^2 (1 + 2 + 3 + 4) / 16.
  EXPECT_NEAR(simulation.ledger().applied / energy, 2.0 * 10.0 / 16.0, 1e-10);
  EXPECT_LT(std::abs(simulation.ledger().residual), 1e-10 * energy);
}

TEST(DrivenSupport, CarriedBlockHasItsMomentumAndTheWorkForIt) {
  const SupportHistory history{{0.0, 10.0}, {Vector3::Zero(), {20, 0, 0}}};
  for (const Integrator integrator :
       {Integrator::dda, Integrator::average_acceleration, Integrator::generalized_alpha}) {
    SimulationSettings settings;
    settings.integrator = integrator;
    settings.time_step = 0.1;
    Simulation simulation = lone(bar(2500, all, history, history), settings);
    ASSERT_TRUE(run_until(simulation, 1.0));
    EXPECT_NEAR(place_of(simulation, 0, {2, 1, 0}).x(), 4.0, 1e-12);
    EXPECT_NEAR(simulation.momentum().x(), 5000.0 * 2.0, 1e-7);
    // All of 1/2 m v^2; weight is carried by the supports without work.
    EXPECT_NEAR(simulation.ledger().applied, 0.5 * 5000.0 * 4.0, 1e-6);
    EXPECT_LT(std::abs(simulation.ledger().residual), 1e-6);
    ASSERT_TRUE(run_until(simulation, 11.0));
    EXPECT_NEAR(place_of(simulation, 0, {2, 1, 0}).x(), 22.0, 1e-11);
    // Stopped again: the work has come back.
    EXPECT_NEAR(simulation.momentum().x(), 0.0, 1e-6);
    EXPECT_NEAR(simulation.ledger().applied, 0.0, 1e-6);
  }
}

TEST(DrivenSupport, CarriesAgainstGravityThatChangesWithoutWork) {
  const SupportHistory history{{0.0, 10.0}, {Vector3::Zero(), {20, 0, 0}}};
  for (const Integrator integrator :
       {Integrator::dda, Integrator::average_acceleration, Integrator::generalized_alpha}) {
    SimulationSettings settings;
    settings.integrator = integrator;
    settings.time_step = 0.1;
    settings.gravity_history = {{0.0, 1.0}, {{0, 0, -9.81}, {-5, 0, -3}}};
    Simulation simulation = lone(bar(2500, all, history, history), settings);
    ASSERT_TRUE(run_until(simulation, 1.0));
    // The work of supports balances that of gravity: 1/2 m v^2 remains.
    EXPECT_NEAR(simulation.ledger().applied, 0.5 * 5000.0 * 4.0, 1e-6);
    EXPECT_LT(std::abs(simulation.ledger().residual), 1e-6);
  }
}

/// A belt with constant speed after a start, under a block laid on it.
Simulation belt(double speed, double friction, double start = 0.0) {
  const SupportHistory history{{start, start + 10.0}, {Vector3::Zero(), {10.0 * speed, 0, 0}}};
  BlockDefinition base =
      block_of("belt", Polyhedron(make_box({-4, -1, -1}, {4, 1, 0})), {1000, 1e11, 0.0}, 1);
  for (const double z : {-1.0, 0.0})
    base.supports.push_back({Plane{{0, 0, z}, Vector3::UnitZ()}, all, history});
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(base));
  blocks.emplace_back(
      block_of("stone", Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 0.2})), {2500, 1e10, 0.0}, 1));
  SimulationSettings settings;
  settings.time_step = 1e-3;
  return {std::move(blocks), {{}, {}}, same_law({1e9, 1e9, friction, 0.0, 0.0, true}), settings};
}

TEST(DrivenSupport, BeltTakesABlockAlong) {
  const double speed = 1.0, friction = 0.5, mass = 500.0;
  Simulation simulation = belt(speed, friction);
  ASSERT_TRUE(run_until(simulation, 0.1));
  EXPECT_NEAR(simulation.blocks()[1].momentum(simulation.states()[1]).x() / (mass * friction * 9.81 * 0.1),
              1.0, 0.01);
  // It has the belt's speed after v / (mu g) = 0.204 s.
  ASSERT_TRUE(run_until(simulation, 0.4));
  EXPECT_NEAR(simulation.blocks()[1].momentum(simulation.states()[1]).x() / (mass * speed), 1.0, 1e-3);
  // Friction dissipated 1/2 m v^2; the belt did as much work on the block, and that for its own motion.
  const double energy = 0.5 * mass * speed * speed;
  const double belt_energy = 0.5 * simulation.blocks()[0].mass() * speed * speed;
  EXPECT_NEAR(simulation.ledger().friction / energy, 1.0, 0.01);
  EXPECT_NEAR((simulation.ledger().applied - belt_energy) / energy, 2.0, 0.02);
  EXPECT_LT(simulation.largest_step_residual(), 1e-8 * belt_energy);
}

TEST(DrivenSupport, GoesOnBitForBit) {
  Simulation straight = belt(1.0, 0.5);
  ASSERT_TRUE(run_until(straight, 0.05));
  const std::string bytes = to_bytes(straight.snapshot());
  ASSERT_TRUE(run_until(straight, 0.1));
  Simulation resumed = belt(1.0, 0.5);
  resumed.restore(snapshot_from_bytes(bytes));
  ASSERT_TRUE(run_until(resumed, 0.1));
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(straight.states()[k].position, resumed.states()[k].position);
    EXPECT_EQ(straight.states()[k].velocity, resumed.states()[k].velocity);
  }
  EXPECT_EQ(straight.ledger().applied, resumed.ledger().applied);
}

TEST(DrivenSupport, SlowBeltInStatics) {
  // Carried along without slip: no force is needed, so that any friction will do.
  Simulation simulation = belt(0.01, 0.1, 0.002);
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing) status = simulation.static_step(0.012);
  ASSERT_EQ(status, StaticStatus::equilibrium);
  EXPECT_NEAR(place_of(simulation, 1, {0.5, 0.5, 0.2}).x(), 0.5 + 1e-4, 1e-8);
}

TEST(DrivenSupport, ABlockReboundsFromABaseThatIsHeldOnOneSide) {
  // The support raises the lower side of the base, whose upper side follows by its equations of motion. The base is as heavy
  // as its support: a block at rest above it leaves with v (1 + e).
  const double speed = 2.0, restitution = 0.5;
  for (const int order : {1, 2}) {
    BlockDefinition base =
        block_of("base", Polyhedron(make_box({-1, -1, -1}, {1, 1, 0})), {2500, 1e10, 0.2}, order);
    base.supports.push_back(
        {Plane{{0, 0, -1}, Vector3::UnitZ()}, all, {{0.0, 1.0}, {Vector3::Zero(), {0, 0, speed}}}});
    std::vector<BlockModel> blocks;
    blocks.emplace_back(std::move(base));
    blocks.emplace_back(
        block_of("block", Polyhedron(make_box({-0.1, -0.1, 0.02}, {0.1, 0.1, 0.22})), {2500, 1e10, 0.2}, 0));
    SimulationSettings settings;
    settings.gravity.setZero();
    settings.time_step = 1e-3;
    settings.contact_distance = 1e-3;
    JointLaw law{1e11, 5e10, 0.5, 0.0, 0.0, true};
    law.rigid = true;
    law.restitution = restitution;
    Simulation simulation(std::move(blocks), {{}, {}}, same_law(law), settings);
    ASSERT_TRUE(run_until(simulation, 0.05));
    const BlockModel& block = simulation.blocks()[1];
    const double reached = block.momentum(simulation.states()[1]).z() / block.mass();
    EXPECT_NEAR(reached / (speed * (1.0 + restitution)), 1.0, 1e-6) << "order " << order;
    EXPECT_LT(std::abs(simulation.ledger().residual), 1e-9 * simulation.ledger().kinetic);
  }
}

}  // namespace
}  // namespace ashlar::driven_support_test
