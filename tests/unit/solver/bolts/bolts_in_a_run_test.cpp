// Bolts and props in motion and statics: forces by hand, energy, momentum, checkpoints.
#include <gtest/gtest.h>

#include "mechanics/bolt/bolt_chain.hpp"
#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar::bolts_in_a_run_test {
namespace {

using test_support::block_of;
using test_support::run_static;
using test_support::same_law;

constexpr double gravity = 9.81;
const Material rock{2500.0, 1e10, 0.2};

/// A bar between two points that is held at its ends.
Bolt bar(int block_a, const Vector3& from, int block_b, const Vector3& to, BoltLaw law) {
  law.anchorage = BoltAnchorage::ends;
  const double length = (to - from).norm();
  return {
      "bar",
      BoltChain(law, BoltShape(law, from, to, {{block_a, 1, 0.0, 0.0}, {block_b, 1, length, length}}, 0.02),
                {true, true}),
      true};
}

BoltLaw elastic(double axial_stiffness) {
  BoltLaw law;
  law.axial_stiffness = axial_stiffness;
  return law;
}

/// A fixed roof and a block of 1 m^3 and 2500 kg under it, with a gap of 1 m.
Simulation hanging(int order, std::vector<Bolt> bolts, SimulationSettings settings = {},
                   const InitialMotion& motion = {}) {
  std::vector<BlockModel> blocks;
  BlockDefinition roof = block_of("block", Polyhedron(make_box({-1, -1, 2}, {2, 2, 3})), rock, 1);
  roof.fixed = true;
  blocks.emplace_back(std::move(roof));
  blocks.emplace_back(block_of("block", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), rock, order));
  settings.gravity = {0, 0, -gravity};
  Simulation simulation(std::move(blocks), {{}, motion}, same_law({1e9, 1e9, 0.5, 0.0, 0.0, true}), settings);
  simulation.add_bolts(std::move(bolts));
  return simulation;
}

std::vector<Bolt> four_bars(double axial_stiffness) {
  std::vector<Bolt> bolts;
  for (const auto& [x, y] : {std::pair(0.1, 0.1), {0.9, 0.1}, {0.1, 0.9}, {0.9, 0.9}})
    bolts.push_back(bar(0, {x, y, 2}, 1, {x, y, 1}, elastic(axial_stiffness)));
  return bolts;
}

TEST(BoltsInARun, HoldABlockThatIsOtherwiseFree) {
  for (const int order : {0, 1, 2}) {
    SimulationSettings settings;
    settings.time_step = 1e-3;
    Simulation simulation = hanging(order, four_bars(1e7), settings);
    EXPECT_TRUE(simulation.loose_blocks().empty());
    EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium) << order;
    const double share = 2500.0 * gravity / 4.0;
    for (const BoltState& bolt : simulation.bolts()) EXPECT_NEAR(bolt.axial[0], share, 1e-4 * share) << order;
    const Vector3 top =
        simulation.blocks()[1].motion_of(simulation.states()[1], {0.5, 0.5, 1.0}).displacement;
    EXPECT_NEAR(top.z(), -share / 1e7, order == 0 ? 1e-4 * share / 1e7 : 0.01 * share / 1e7) << order;
  }
}

TEST(BoltsInARun, ABlockSwingsOnTwoBarsWithItsEnergy) {
  SimulationSettings settings;
  settings.time_step = 2e-3;
  settings.integrator = Integrator::average_acceleration;
  // A pendulum: both bars stay parallel.
  Simulation simulation = hanging(0, four_bars(1e7), settings, {.velocity = {1.0, 0.0, 0.0}});
  const double start = simulation.ledger().balance();
  double highest = 0.0;
  for (int k = 0; k < 500; ++k) {
    ASSERT_EQ(simulation.step(10.0), StepStatus::accepted);
    highest = std::max(
        highest, simulation.blocks()[1].motion_of(simulation.states()[1], {0.5, 0.5, 0.5}).displacement.z());
  }
  EXPECT_NEAR(simulation.ledger().balance(), start, 1e-6 * simulation.largest_energy());
  EXPECT_LE(std::abs(simulation.ledger().residual), 1e-6 * simulation.largest_energy());
  // v^2 / 2 g, less what the bars stretch.
  EXPECT_NEAR(highest, 1.0 / (2.0 * gravity), 0.02 / (2.0 * gravity));
}

TEST(BoltsInARun, BoltedFreeBlocksKeepTheirMomenta) {
  SimulationSettings settings;
  settings.time_step = 1e-3;
  settings.integrator = Integrator::average_acceleration;
  settings.gravity.setZero();
  std::vector<BlockModel> blocks;
  blocks.emplace_back(block_of("block", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), rock, 1));
  blocks.emplace_back(block_of("block", Polyhedron(make_box({0, 0, 2}, {1, 1, 3})), rock, 1));
  Simulation simulation(std::move(blocks), {{}, {{0.3, -0.2, 0.5}, {0.4, 0.1, 0.3}}},
                        same_law({1e9, 1e9, 0.5, 0.0, 0.0, true}), settings);
  simulation.add_bolts({bar(0, {0.2, 0.3, 1}, 1, {0.6, 0.5, 2}, elastic(1e7))});
  const Vector3 momentum = simulation.momentum(), spin = simulation.angular_momentum();
  for (int k = 0; k < 200; ++k) ASSERT_EQ(simulation.step(10.0), StepStatus::accepted);
  EXPECT_GT(std::abs(largest_axial_force(simulation.bolts()[0])), 1e3);
  EXPECT_LE((simulation.momentum() - momentum).norm(), 1e-9 * momentum.norm());
  EXPECT_LE((simulation.angular_momentum() - spin).norm(), 1e-8 * spin.norm());
}

TEST(BoltsInARun, MotionFromEquilibriumStaysAtRest) {
  SimulationSettings settings;
  settings.time_step = 1e-3;
  Simulation simulation = hanging(1, four_bars(1e7), settings);
  ASSERT_EQ(simulation.start_from_statics(), StaticStatus::equilibrium);
  const double share = 2500.0 * gravity / 4.0;
  // 1/2 F^2 L / EA of each bar.
  EXPECT_NEAR(simulation.ledger().contact, 4.0 * 0.5 * share * share / 1e7, 1e-3 * share * share / 1e7);
  for (int k = 0; k < 100; ++k) ASSERT_EQ(simulation.step(1.0), StepStatus::accepted);
  EXPECT_LE(std::abs(simulation.ledger().residual), 1e-9);
  for (const BoltState& bolt : simulation.bolts()) EXPECT_NEAR(bolt.axial[0], share, 1e-4 * share);
}

TEST(BoltsInARun, AYieldingPropLetsTheBlockDown) {
  // Under the block; it yields below the weight.
  SimulationSettings settings;
  settings.time_step = 1e-3;
  BoltLaw law = elastic(1e7);
  law.yield_force = 0.5 * 2500.0 * gravity;
  Simulation simulation = hanging(1, {bar(0, {0.5, 0.5, 2}, 1, {0.5, 0.5, 1}, law)}, settings);
  for (int k = 0; k < 200; ++k) ASSERT_EQ(simulation.step(0.2), StepStatus::accepted);
  // x = (1 - cos(w t)) g / w^2 up to the yield force, w t = pi / 3; with g / 2 from there on.
  const double w = std::sqrt(1e7 / 2500.0);
  const double yielding = 0.2 - std::numbers::pi / 3.0 / w;
  const double expected = 0.5 * gravity / (w * w) +
                          gravity / w * std::sin(std::numbers::pi / 3.0) * yielding +
                          0.25 * gravity * yielding * yielding;
  const Vector3 travel =
      simulation.blocks()[1].motion_of(simulation.states()[1], {0.5, 0.5, 0.5}).displacement;
  EXPECT_NEAR(travel.z(), -expected, 0.01 * expected);
  EXPECT_NEAR(simulation.bolts()[0].axial[0], law.yield_force, 1.0);
  EXPECT_EQ(condition_of(simulation.system().bolts()[0], simulation.bolts()[0]), BoltCondition::yielded);
  EXPECT_NEAR(simulation.ledger().friction, law.yield_force * -travel.z(),
              0.05 * law.yield_force * -travel.z());
}

TEST(BoltsInARun, ABarRupturesAtItsStrain) {
  SimulationSettings settings;
  settings.time_step = 1e-3;
  BoltLaw law = elastic(1e7);
  law.yield_force = 0.5 * 2500.0 * gravity;
  law.rupture_strain = 0.02;
  Simulation simulation = hanging(1, {bar(0, {0.5, 0.5, 2}, 1, {0.5, 0.5, 1}, law)}, settings);
  for (int k = 0; k < 200; ++k) ASSERT_EQ(simulation.step(0.2), StepStatus::accepted);
  EXPECT_EQ(simulation.bolts()[0].axial[0], 0.0);
  EXPECT_EQ(condition_of(simulation.system().bolts()[0], simulation.bolts()[0]), BoltCondition::ruptured);
  EXPECT_LE(std::abs(simulation.ledger().residual), 1e-6 * simulation.largest_energy());
  // In statics it cannot stand either.
  Simulation still = hanging(1, {bar(0, {0.5, 0.5, 2}, 1, {0.5, 0.5, 1}, law)}, settings);
  EXPECT_EQ(run_static(still, 1.0), StaticStatus::moving);
}

/// Two blocks on each other with a grouted bolt through both into a fixed base.
Simulation bolted_stack(int threads) {
  SimulationSettings settings;
  settings.time_step = 1e-3;
  settings.threads = threads;
  settings.gravity = {3.0, 0.0, -gravity};
  std::vector<BlockModel> blocks;
  BlockDefinition base = block_of("block", Polyhedron(make_box({-1, -1, -2}, {2, 2, 0})), rock, 1);
  base.fixed = true;
  blocks.emplace_back(std::move(base));
  blocks.emplace_back(block_of("block", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), rock, 1));
  blocks.emplace_back(block_of("block", Polyhedron(make_box({0, 0, 1}, {1, 1, 2})), rock, 2));
  Simulation simulation(std::move(blocks), {{}, {}, {}}, same_law({1e9, 1e9, 0.2, 0.0, 0.0, true}), settings);
  BoltLaw law = elastic(1e8);
  law.bond_stiffness = 1e9;
  law.bond_strength = 2e4;
  law.shear_stiffness = 1e7;
  law.shear_strength = 2e3;
  const std::vector<BoltSpan> spans = {{2, 2, 0.0, 1.0}, {1, 1, 1.0, 2.0}, {0, 1, 2.0, 3.0}};
  simulation.add_bolts(
      {{"a", BoltChain(law, BoltShape(law, {0.4, 0.5, 2}, {0.4, 0.5, -1}, spans, 0.03), {true, true, true}),
        true}});
  return simulation;
}

TEST(BoltsInARun, ResumesToTheBitForAnyNumberOfThreads) {
  Simulation whole = bolted_stack(1), parallel = bolted_stack(3), first = bolted_stack(1);
  for (int k = 0; k < 40; ++k) {
    ASSERT_EQ(whole.step(1.0), StepStatus::accepted);
    ASSERT_EQ(parallel.step(1.0), StepStatus::accepted);
  }
  for (int k = 0; k < 20; ++k) ASSERT_EQ(first.step(1.0), StepStatus::accepted);
  EXPECT_NE(condition_of(first.system().bolts()[0], first.bolts()[0]), BoltCondition::elastic);
  Simulation resumed = bolted_stack(1);
  resumed.restore(snapshot_from_bytes(to_bytes(first.snapshot())));
  for (int k = 0; k < 20; ++k) ASSERT_EQ(resumed.step(1.0), StepStatus::accepted);
  for (const Simulation* other : {&parallel, &resumed})
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(whole.states()[k].position, other->states()[k].position);
  EXPECT_EQ(whole.bolts()[0].axial, resumed.bolts()[0].axial);
  EXPECT_LE(std::abs(whole.ledger().residual), 1e-6 * whole.largest_energy());
}

TEST(BoltsInARun, AStageInstallsThemWithoutForceAndRemovesThem) {
  SimulationSettings settings;
  settings.time_step = 1e-3;
  const auto with = [&](bool first, bool second) {
    std::vector<Bolt> bolts = {bar(0, {0.5, 0.5, 2}, 1, {0.5, 0.5, 1}, elastic(1e6)),
                               bar(0, {0.5, 0.5, 2}, 1, {0.5, 0.5, 1}, elastic(1e6))};
    bolts[0].installed = first;
    bolts[1].installed = second;
    return hanging(1, std::move(bolts), settings);
  };
  Simulation one = with(true, false);
  EXPECT_EQ(run_static(one, 1.0), StaticStatus::equilibrium);
  Simulation two = with(true, true);
  two.start_stage(one.snapshot(), {false, false});
  const double weight = 2500.0 * gravity;
  EXPECT_NEAR(two.bolts()[0].axial[0], weight, 1e-3 * weight);
  EXPECT_NEAR(two.bolts()[1].axial[0], 0.0, 1e-3);
  EXPECT_EQ(run_static(two, 1.0), StaticStatus::equilibrium);
  EXPECT_NEAR(two.bolts()[1].axial[0], 0.0, 1e-3 * weight);
  Simulation three = with(false, true);
  three.start_stage(two.snapshot(), {false, false});
  EXPECT_EQ(run_static(three, 1.0), StaticStatus::equilibrium);
  EXPECT_FALSE(three.bolts()[0].installed());
  EXPECT_NEAR(three.bolts()[1].axial[0], weight, 1e-3 * weight);
}

}  // namespace
}  // namespace ashlar::bolts_in_a_run_test
