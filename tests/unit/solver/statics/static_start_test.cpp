// Motion that starts from the static state.
#include <gtest/gtest.h>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar::static_start_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::place_of;
using test_support::run_until;
using test_support::same_law;

const Material rock{2500.0, 1e9, 0.2};

SimulationSettings multipliers() {
  SimulationSettings settings;
  settings.augmented = true;
  settings.time_step = 5e-3;
  return settings;
}

/// A stack of two cubes on a floor, and a cube in the air beside it that is thrown.
Simulation stack_and_stone(const SimulationSettings& settings) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-5, -5, -1}, {5, 5, 0}));
  blocks.emplace_back(block_of("low", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), rock, 2));
  blocks.emplace_back(block_of("high", Polyhedron(make_box({0.2, 0, 1}, {1.2, 1, 2})), rock, 1));
  blocks.emplace_back(block_of("stone", Polyhedron(make_box({3, 0, 3}, {3.5, 0.5, 3.5})), rock, 1));
  std::vector<InitialMotion> motions(4);
  motions[3].velocity = {1.0, 0, 2.0};
  return {std::move(blocks), motions, same_law({1e10, 5e9, 0.6, 0.0, 0.0, true}), settings};
}

TEST(StaticStart, WhatIsHeldStaysAndWhatIsThrownFlies) {
  Simulation simulation = stack_and_stone(multipliers());
  ASSERT_EQ(simulation.start_from_statics(), StaticStatus::equilibrium);
  EXPECT_EQ(simulation.time(), 0.0);
  EXPECT_EQ(simulation.steps(), 0);
  const Vector3 low(0.5, 0.5, 1.0), high(0.7, 0.5, 2.0), stone(3.25, 0.25, 3.25);
  const Vector3 low_at = place_of(simulation, 1, low), high_at = place_of(simulation, 2, high);
  // Pressed together by its weight, which the start as placed is not.
  EXPECT_LT(low_at.z(), 1.0 - 1e-5);
  EXPECT_NEAR((place_of(simulation, 3, stone) - stone).norm(), 0.0, 1e-14);
  ASSERT_TRUE(run_until(simulation, 0.25));
  EXPECT_NEAR((place_of(simulation, 1, low) - low_at).norm(), 0.0, 1e-9);
  EXPECT_NEAR((place_of(simulation, 2, high) - high_at).norm(), 0.0, 1e-9);
  EXPECT_NEAR(place_of(simulation, 3, stone).x(), 3.5, 1e-9);
  EXPECT_NEAR(place_of(simulation, 3, stone).z(), 3.25 + 2.0 * 0.25 - 0.5 * 9.81 * 0.0625, 1e-9);
  EXPECT_LT(simulation.largest_step_residual(), 1e-8 * simulation.largest_energy());
}

// Five courses in running bond. Multipliers have the energy of springs in statics, and a step may release it: otherwise the
// residual motion of the static iteration would lower the forces of bricks until no equilibrium is left.
TEST(StaticStart, AWallStaysWithFewIterationsAStep) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-1, -1, -0.5}, {3, 1, 0}));
  for (int course = 0; course < 5; ++course) {
    const double low = 0.2 * course;
    std::vector<double> ends{0.0, 0.5, 1.0, 1.5, 2.0};
    if (course % 2 == 1) ends = {0.0, 0.25, 0.75, 1.25, 1.75, 2.0};
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
      blocks.emplace_back(block_of("brick",
                                   Polyhedron(make_box({ends[k], 0, low}, {ends[k + 1], 0.25, low + 0.2})),
                                   {2500.0, 1e10, 0.2}, 1));
  }
  SimulationSettings settings = multipliers();
  settings.time_step = 1e-3;
  const std::vector<InitialMotion> motions(blocks.size());
  Simulation simulation(std::move(blocks), motions, same_law({4e11, 4e11, 0.7, 0.0, 0.0, true}), settings);
  ASSERT_EQ(simulation.start_from_statics(), StaticStatus::equilibrium);
  const Vector3 top(1.0, 0.125, 1.0);
  const Vector3 at_start = place_of(simulation, 20, top);
  for (int step = 1; step <= 5; ++step) {
    ASSERT_TRUE(run_until(simulation, step * settings.time_step));
    EXPECT_LE(simulation.report().iterations, 10) << step;
  }
  EXPECT_TRUE(simulation.rejections().empty());
  EXPECT_LT((place_of(simulation, 20, top) - at_start).norm(), 1e-8);
}

TEST(StaticStart, GoesOnFromASnapshot) {
  Simulation simulation = stack_and_stone(multipliers());
  ASSERT_EQ(simulation.start_from_statics(), StaticStatus::equilibrium);
  Simulation resumed = stack_and_stone(multipliers());
  resumed.restore(snapshot_from_bytes(to_bytes(simulation.snapshot())));
  ASSERT_TRUE(run_until(simulation, 0.05));
  ASSERT_TRUE(run_until(resumed, 0.05));
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(simulation.states()[k].position, resumed.states()[k].position) << k;
}

TEST(StaticStart, EndsWhereItIsToldToWithAllAsPlaced) {
  Simulation simulation = stack_and_stone(multipliers());
  int left = 3;
  EXPECT_EQ(simulation.start_from_statics([&] { return --left >= 0; }), StaticStatus::balancing);
  EXPECT_EQ(left, -1) << "asked before each iteration";
  EXPECT_EQ(simulation.steps(), 0);
  const Vector3 low(0.5, 0.5, 1.0);
  EXPECT_EQ(place_of(simulation, 1, low), low);
  // The analysis is counted, but leaves nothing that motion depends on.
  ASSERT_TRUE(run_until(simulation, 0.05));
  Simulation fresh = stack_and_stone(multipliers());
  ASSERT_TRUE(run_until(fresh, 0.05));
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(simulation.states()[k].position, fresh.states()[k].position);
}

TEST(StaticStart, WhatNothingHoldsStartsAsPlaced) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-5, -5, -1}, {5, 5, 0}));
  blocks.emplace_back(block_of("cube", Polyhedron(make_box({4.4, 0, 0}, {5.6, 1, 1})), rock, 1));
  blocks.emplace_back(block_of("over", Polyhedron(make_box({4.7, 0, 1}, {6.7, 1, 2})), rock, 1));
  Simulation simulation(std::move(blocks), std::vector<InitialMotion>(3),
                        same_law({1e10, 5e9, 0.6, 0.0, 0.0, true}), multipliers());
  EXPECT_EQ(simulation.start_from_statics(), StaticStatus::moving);
  EXPECT_EQ(simulation.steps(), 0);
  EXPECT_NEAR((place_of(simulation, 1, {5, 0, 0}) - Vector3(5, 0, 0)).norm(), 0.0, 1e-14);
  EXPECT_TRUE(run_until(simulation, 0.2));
  EXPECT_LT(place_of(simulation, 2, {6.7, 0, 2}).z(), 1.99);
}

}  // namespace
}  // namespace ashlar::static_start_test
