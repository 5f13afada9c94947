#include "solver/fracture/cracked_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include "support/simulations.hpp"

namespace ashlar::cracked_blocks_test {
namespace {

constexpr double strength = 3e6, young = 3e10, length = 0.3, side = 0.1, energy = 100.0;

/// A bar whose end moves so that it reaches its strength at 0.1 s.
BlockDefinition bar() {
  BlockDefinition bar = test_support::block_of("bar", Polyhedron(make_box({0, 0, 0}, {length, side, side})),
                                               {2500, young, 0.0}, 2);
  bar.supports.push_back({Plane{{0, 0, 0}, Vector3::UnitX()}, {true, true, true}, {}});
  bar.supports.push_back({Plane{{length, 0, 0}, Vector3::UnitX()},
                          {true, true, true},
                          {{0.0, 1.0}, {Vector3::Zero(), Vector3(10.0 * length * strength / young, 0, 0)}}});
  return bar;
}

CrackLaw law() {
  JointLaw joint{1e15, 1e15, 0.5, 4.0 * strength, strength, true};
  joint.fracture = {energy, 4.0 * energy};
  return {strength, 0.05, joint};
}

struct CrackingBar {
  explicit CrackingBar(int threads = 1, double time_step = 2e-3) {
    SimulationSettings settings;
    settings.gravity.setZero();
    settings.time_step = time_step;
    settings.threads = threads;
    std::vector<BlockModel> blocks;
    blocks.emplace_back(bar());
    simulation = std::make_unique<Simulation>(std::move(blocks), std::vector<InitialMotion>(1),
                                              test_support::same_law(law().joint), settings);
    cracks = std::make_unique<CrackedBlocks>(
        std::vector<std::optional<CrackLaw>>{law()}, [](int) { return bar(); }, *simulation, 10);
  }

  void until(double time) {
    while (!simulation->reached(time)) {
      ASSERT_EQ(simulation->step(time), StepStatus::accepted);
      cracks->divide(*simulation, 0, false);
    }
  }

  std::unique_ptr<Simulation> simulation;
  std::unique_ptr<CrackedBlocks> cracks;
};

TEST(CrackedBlocks, ABarCracksOnceAtItsStrengthAndSpendsItsFractureEnergy) {
  CrackingBar run;
  run.until(0.098);
  EXPECT_TRUE(run.cracks->record().events.empty());
  run.until(0.25);  // 2 G/f_t is 2.2 times the elongation at the strength
  ASSERT_EQ(run.cracks->record().events.size(), 1U);
  const CrackEvent& crack = run.cracks->record().events.front();
  EXPECT_NEAR(crack.time, 0.1, 3e-3);
  EXPECT_NEAR(crack.stress, strength, 0.03 * strength);
  EXPECT_NEAR(crack.point.x(), 0.5 * length, 1e-12);
  EXPECT_EQ(crack.normal, Vector3(1, 0, 0));
  EXPECT_NEAR(crack.area, side * side, 1e-16);
  EXPECT_NEAR(run.simulation->ledger().friction, energy * side * side, 0.01 * energy * side * side);
  EXPECT_NEAR(energy_of_cracks(*run.simulation, {0, 0}), energy * side * side, 1e-9);
  EXPECT_LT(std::abs(run.simulation->ledger().residual), 1e-10);
}

TEST(CrackedBlocks, RepeatedCracksAndARestoredStateContinueToTheBit) {
  CrackingBar straight;
  straight.until(0.11);
  ASSERT_EQ(straight.cracks->record().events.size(), 1U);
  CrackingBar resumed;
  resumed.cracks->repeat(straight.cracks->record(), *resumed.simulation);
  resumed.simulation->restore(snapshot_from_bytes(to_bytes(straight.simulation->snapshot())));
  for (CrackingBar* run : {&straight, &resumed}) run->until(0.15);
  for (const std::size_t part : {0U, 1U}) {
    EXPECT_EQ(straight.simulation->states()[part].position, resumed.simulation->states()[part].position);
    EXPECT_EQ(straight.simulation->states()[part].velocity, resumed.simulation->states()[part].velocity);
  }
  EXPECT_EQ(straight.simulation->ledger().friction, resumed.simulation->ledger().friction);
}

TEST(CrackedBlocks, ThreadsDoNotChangeABit) {
  CrackingBar one(1), two(2);
  one.until(0.12);
  two.until(0.12);
  ASSERT_EQ(one.simulation->states().size(), 2U);
  ASSERT_EQ(two.simulation->states().size(), 2U);
  for (const std::size_t part : {0U, 1U})
    EXPECT_EQ(one.simulation->states()[part].position, two.simulation->states()[part].position);
}

// Tension grows to the strength at 0.1 s: the level that would pass it ends there. The next one has its whole
// length again.
TEST(CrackedBlocks, ALoadLevelEndsWhereTheStrengthIsReached) {
  std::mt19937 random(1);
  for (int n = 0; n < 12; ++n) {
    const double level = std::uniform_real_distribution<double>(0.02, 0.095)(random);
    CrackingBar run(1, level);
    std::vector<double> times;
    while (!run.simulation->reached(0.3)) {
      const double end = run.cracks->time_of_next_crack(level).value_or(0.3);
      const StaticStatus found = run.simulation->static_step(end);
      ASSERT_TRUE(found == StaticStatus::balancing || found == StaticStatus::equilibrium);
      if (!run.simulation->snapshot().run.statics.balanced) continue;
      if (times.empty() || times.back() != run.simulation->time()) times.push_back(run.simulation->time());
      run.cracks->divide(*run.simulation, 0, true);
      if (run.simulation->time() > 0.25) break;
    }
    ASSERT_EQ(run.cracks->record().events.size(), 1U);
    const CrackEvent& crack = run.cracks->record().events.front();
    EXPECT_NEAR(crack.time, 0.1 * 1.0005, 1e-9);
    EXPECT_NEAR(crack.stress, 1.0005 * strength, 1e-6 * strength);
    const auto at_crack = std::find(times.begin(), times.end(), crack.time);
    ASSERT_TRUE(at_crack != times.end() && at_crack + 1 != times.end());
    EXPECT_NEAR(at_crack[1], crack.time + level, 1e-12);
  }
}

}  // namespace
}  // namespace ashlar::cracked_blocks_test
