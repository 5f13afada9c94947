#include "apps/results/tables/measure_goals.hpp"

#include <gtest/gtest.h>

#include "support/simulations.hpp"

namespace ashlar::measure_goals_test {
namespace {

/// A cube of 2500 kg on a base, to move at 2 m/s along x.
Simulation cube() {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(test_support::fixed_box({-1, -1, -1}, {2, 2, 0}));
  blocks.emplace_back(
      test_support::block_of("cube", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2500, 1e9, 0.2}, 1));
  SimulationSettings settings;
  settings.gravity = Vector3(0, 0, -10);
  return {
      std::move(blocks), {{}, {{2, 0, 0}, {0, 0, 0}}}, test_support::same_law({1e11, 1e11, 0.0}), settings};
}

TEST(MeasureGoals, APointHasItsDisplacementAndVelocity) {
  Simulation simulation = cube();
  ASSERT_TRUE(test_support::run_until(simulation, 0.1));
  const std::vector<Measure> measures = {
      {.name = "middle", .kind = Measure::Kind::point, .block = 1, .point = Vector3(0.5, 0.5, 0.5)}};
  const std::vector<Goal> goals = goals_of(simulation, measures);
  ASSERT_EQ(goals.size(), 1U);
  EXPECT_EQ(goals[0].name, "middle");
  EXPECT_NEAR(goals[0].values.at(0), 0.2, 1e-9);
  EXPECT_NEAR(goals[0].rates.at(0), 2.0, 1e-9);
  // Of the displacement of the only block that moves.
  EXPECT_NEAR(goals[0].least, 1e-6 * 0.2, 1e-3 * 1e-6 * 0.2);
}

TEST(MeasureGoals, APairHasItsForces) {
  Simulation simulation = cube();
  ASSERT_EQ(test_support::run_static(simulation, 1.0), StaticStatus::equilibrium);
  const std::vector<Measure> measures = {
      {.name = "foot", .kind = Measure::Kind::pair, .block = 0, .other = 1}};
  const std::vector<Goal> goals = goals_of(simulation, measures);
  ASSERT_EQ(goals.at(0).values.size(), 2U);
  EXPECT_NEAR(goals[0].values[0], 25000.0, 1e-3);
  EXPECT_NEAR(goals[0].values[1], 0.0, 1e-3);
  EXPECT_TRUE(goals[0].rates.empty());
  EXPECT_NEAR(goals[0].least, 1e-6 * 25000.0, 1e-8);
}

}  // namespace
}  // namespace ashlar::measure_goals_test
