// Orders that change during a run.
#include <gtest/gtest.h>

#include <stdexcept>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar::block_changes_test {
namespace {

const Material soft{2000.0, 2e7, 0.25};

/// A stone that slides on a clamped beam.
Simulation stone_on_beam(Integrator integrator = Integrator::dda) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(
      test_support::block_of("stone", Polyhedron(make_box({0.5, 0.1, 0.5005}, {1.5, 0.9, 1.0})), soft, 1));
  BlockDefinition beam =
      test_support::block_of("beam", Polyhedron(make_box({0, 0, 0}, {2, 1, 0.5})), soft, 2);
  beam.supports.push_back({Plane{Vector3::Zero(), Vector3::UnitX()}});
  blocks.emplace_back(std::move(beam));
  SimulationSettings settings;
  settings.time_step = 1e-3;
  settings.integrator = integrator;
  return {std::move(blocks),
          {{{0.4, 0.0, -0.3}, Vector3::Zero()}, {}},
          test_support::same_law({1e9, 1e9, 0.2, 0, 0, true}),
          settings};
}

void take_steps(Simulation& simulation, int count) {
  for (int k = 0; k < count; ++k) ASSERT_EQ(simulation.step(1.0), StepStatus::accepted);
}

TEST(BlockChanges, RaisedOrdersKeepPlaceVelocityEnergyAndContacts) {
  for (const Integrator integrator : {Integrator::dda, Integrator::generalized_alpha}) {
    Simulation simulation = stone_on_beam(integrator);
    take_steps(simulation, 6);
    ASSERT_GT(simulation.report().locked + simulation.report().sliding, 0);
    const Vector3 tip = test_support::place_of(simulation, 1, {2, 1, 0.5});
    const Ledger before = simulation.ledger();
    for (const int block : {0, 1}) {
      const DroppedByOrder dropped = simulation.change_order(block, 4);
      EXPECT_LT(dropped.displacement, 1e-13);
      EXPECT_LT(dropped.velocity, 1e-12);
      EXPECT_LT(std::abs(dropped.energy), 1e-8 * before.kinetic);
      EXPECT_EQ(simulation.blocks()[static_cast<std::size_t>(block)].order(), 4);
    }
    EXPECT_LT((test_support::place_of(simulation, 1, {2, 1, 0.5}) - tip).norm(), 1e-12);
    EXPECT_NEAR(simulation.ledger().elastic, before.elastic, 1e-8 * before.elastic);
    take_steps(simulation, 1);
    EXPECT_GT(simulation.report().locked + simulation.report().sliding, 0);
    EXPECT_LT(std::abs(simulation.ledger().residual - before.residual), 1e-2 * before.kinetic);
  }
}

TEST(BlockChanges, LoweringReportsWhatItDrops) {
  // At rest and bent by its weight, the beam loses all of order 2: the elastic energy of a lower order is
  // smaller.
  Simulation simulation = stone_on_beam();
  simulation.settle_supported_blocks();
  const BlockModel beam = simulation.blocks()[1];
  const BlockState bent = simulation.states()[1];
  const Ledger before = simulation.ledger();
  const DroppedByOrder dropped = simulation.change_order(1, 1);
  const BlockModel& low = simulation.blocks()[1];
  const BlockState& state = simulation.states()[1];
  // Root of the mean square of the difference of both fields, by points of a fine grid.
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 20; ++j) {
      for (int k = 0; k < 10; ++k, ++count) {
        const Vector3 point((i + 0.5) / 20.0, (j + 0.5) / 20.0, (k + 0.5) / 20.0);
        sum += (beam.motion_of(bent, point).place - low.motion_of(state, point).place).squaredNorm();
      }
    }
  }
  EXPECT_GT(dropped.displacement, 1e-4);
  EXPECT_NEAR(dropped.displacement, std::sqrt(sum / count), 2e-2 * dropped.displacement);
  EXPECT_EQ(dropped.velocity, 0.0);
  EXPECT_NEAR(dropped.energy,
              before.elastic + before.gravity - simulation.ledger().elastic - simulation.ledger().gravity,
              1e-9 * before.elastic);
  EXPECT_NEAR(simulation.ledger().balance(), before.balance(), 1e-9 * before.elastic);
}

TEST(BlockChanges, AResumedRunKnowsTheOrders) {
  Simulation straight = stone_on_beam();
  take_steps(straight, 12);
  (void)straight.change_order(0, 3);
  take_steps(straight, 3);
  const std::string bytes = to_bytes(straight.snapshot());
  take_steps(straight, 5);
  Simulation resumed = stone_on_beam();
  resumed.restore(snapshot_from_bytes(bytes));
  EXPECT_EQ(resumed.blocks()[0].order(), 3);
  take_steps(resumed, 5);
  SimulationSnapshot expected = straight.snapshot();
  SimulationSnapshot reached = resumed.snapshot();
  expected.run.log.seconds = reached.run.log.seconds;
  expected.run.log.counts.factors = reached.run.log.counts.factors;
  EXPECT_EQ(to_bytes(reached), to_bytes(expected));
}

TEST(BlockChanges, OrdersThatCannotBeAreRefused) {
  Simulation simulation = stone_on_beam();
  const std::string before = to_bytes(simulation.snapshot());
  EXPECT_THROW((void)simulation.change_order(0, 13), std::invalid_argument);
  EXPECT_EQ(to_bytes(simulation.snapshot()), before);
  std::vector<BlockModel> blocks;
  BlockDefinition base = test_support::block_of("base", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), soft, 1);
  base.fixed = true;
  blocks.emplace_back(std::move(base));
  Simulation rigid(std::move(blocks), {{}}, test_support::same_law({}), {});
  EXPECT_THROW((void)rigid.change_order(0, 2), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::block_changes_test
