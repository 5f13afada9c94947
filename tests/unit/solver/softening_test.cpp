// Bonds with fracture energy in a run. Work, forces and unloading: `ashlar verify`.
#include <gtest/gtest.h>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar::softening_test {
namespace {

/// A block bonded to a floor, whose top is pulled off by 3 mm in 0.3 s: the bond fails at 1 mm.
Simulation pulled_off() {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(test_support::fixed_box({-1, -1, -1}, {2, 2, 0}));
  BlockDefinition block =
      test_support::block_of("block", Polyhedron(make_box({0, 0, 0}, {1, 1, 0.5})), {2500, 1e9, 0.0}, 1);
  block.supports.push_back({Plane{{0, 0, 0.5}, Vector3::UnitZ()},
                            {true, true, true},
                            {{0.0, 0.3}, {Vector3::Zero(), Vector3(0, 0, 3e-3)}}});
  blocks.emplace_back(std::move(block));
  JointLaw law{1e10, 1e10, 0.5, 2e5, 1e5, true};
  law.fracture = {50.0, 200.0};
  SimulationSettings settings;
  settings.gravity.setZero();
  settings.time_step = 1e-3;
  return {std::move(blocks), {{}, {}}, test_support::same_law(law), settings};
}

TEST(Softening, ARunThatIsResumedOnTheFallingBranchTakesTheSameSteps) {
  Simulation straight = pulled_off();
  ASSERT_TRUE(test_support::run_until(straight, 0.05));
  const double damage = straight.histories().begin()->second.memory.entries().front().memory.damage;
  EXPECT_GT(damage, 0.3);
  EXPECT_LT(damage, 0.6);
  EXPECT_EQ(straight.histories().begin()->second.broken, 0.0);
  Simulation resumed = pulled_off();
  resumed.restore(snapshot_from_bytes(to_bytes(straight.snapshot())));
  for (Simulation* run : {&straight, &resumed}) ASSERT_TRUE(test_support::run_until(*run, 0.2));
  EXPECT_EQ(straight.states()[1].position, resumed.states()[1].position);
  EXPECT_EQ(straight.states()[1].velocity, resumed.states()[1].velocity);
  EXPECT_EQ(straight.ledger().friction, resumed.ledger().friction);
  EXPECT_EQ(straight.ledger().numerical, resumed.ledger().numerical);
  EXPECT_NEAR(straight.histories().begin()->second.broken, 1.0, 1e-9);
  EXPECT_NEAR(straight.ledger().friction, 50.0, 1e-6);
}

}  // namespace
}  // namespace ashlar::softening_test
