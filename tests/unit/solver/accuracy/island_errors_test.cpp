#include "solver/accuracy/island_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar::island_errors_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::run_until;
using test_support::same_law;

const Material rock{2000.0, 1e8, 0.25};

/// Boxes of 1 m in a row on a base, the second on the first, the third beside them.
Simulation stack_and_box() {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-1, -1, -1}, {6, 2, 0}));
  for (const Vector3& corner : {Vector3(0, 0, 0), Vector3(0, 0, 1), Vector3(3, 0, 0)})
    blocks.emplace_back(block_of("box", Polyhedron(make_box(corner, corner + Vector3::Ones())), rock, 1));
  const std::vector<InitialMotion> at_rest(4);
  return {std::move(blocks), at_rest, same_law({1e9, 1e9, 0.5}), SimulationSettings{}};
}

TEST(IslandErrors, BlocksInTouchAreAnIslandAndFixedOnesNone) {
  Simulation simulation = stack_and_box();
  ASSERT_TRUE(run_until(simulation, 0.01));
  EXPECT_EQ(blocks_in_touch(simulation), (std::vector<std::vector<int>>{{1, 2}, {3}}));
}

// 3 mm of displacement, and 0.1 m/s of 2000 kg: 10 J.
TEST(IslandErrors, ADifferenceHasADisplacementAndAnEnergy) {
  const Simulation simulation = stack_and_box();
  std::vector<BlockState> a = simulation.states(), b = a;
  // The first function is constant: 1 / sqrt(volume), of 1 m^3.
  b[1].position.row(0) += Vector3(0.003, 0, 0).transpose();
  b[2].velocity.row(0) += Vector3(0, 0.1, 0).transpose();
  const std::vector<BlockDifference> differences = block_differences(simulation, a, b);
  EXPECT_NEAR(differences[1].displacement, 0.003, 1e-12);
  EXPECT_NEAR(differences[2].energy, 10.0, 1e-9);
  EXPECT_EQ(differences[3].energy, 0.0);
  MotionScales scales;
  scales.energy = 1000.0;
  scales.displacement = 0.3;
  EXPECT_NEAR(relative_difference(differences, {1, 2}, scales), 0.1, 1e-6) << "root of 10 / 1000";
  EXPECT_NEAR(relative_difference(differences, {1}, scales), 0.01, 1e-6);
}

// With errors of 0.04 and 0.01 the others allow twice the step of an integrator of order 2, four times that of order 1.
TEST(IslandErrors, TheLargestErrorBoundsTheStep) {
  MotionScales scales;
  scales.displacement = 1.0;
  const std::vector<BlockDifference> differences = {{}, {0.0, 0.01}, {0.0, 0.005}, {0.0, 0.04}};
  const std::vector<std::vector<int>> islands = {{1, 2}, {3}};
  const BoundingIsland second = bounding_island(islands, differences, scales, 2);
  EXPECT_EQ(second.blocks, std::vector<int>{3});
  EXPECT_NEAR(second.gain, 2.0, 1e-12);
  EXPECT_NEAR(bounding_island(islands, differences, scales, 1).gain, 4.0, 1e-12);
  EXPECT_EQ(bounding_island({{3}}, differences, scales, 1).gain, 0.0) << "no others";
  EXPECT_TRUE(bounding_island(islands, std::vector<BlockDifference>(4), scales, 1).blocks.empty());
}

// Of two free cubes that swell the stiffer one, of 100 times Young's modulus, has ten times the frequency.
TEST(IslandErrors, TheStifferOfTwoFreeCubesBoundsTheStep) {
  std::vector<BlockModel> blocks;
  for (const double stiffer : {1.0, 100.0}) {
    const Vector3 corner(3.0 * stiffer, 0, 0);
    blocks.emplace_back(block_of("cube", Polyhedron(make_box(corner, corner + Vector3::Ones())),
                                 {2000.0, 1e8 * stiffer, 0.25}, 1));
  }
  SimulationSettings settings;
  settings.gravity.setZero();
  settings.integrator = Integrator::average_acceleration;
  const double end = 0.02;
  settings.time_step = end / 256;
  Simulation simulation(std::move(blocks), {{}, {}}, same_law({1e9, 1e9, 0.5}), settings);
  SimulationSnapshot snapshot = simulation.snapshot();
  for (BlockState& state : snapshot.run.states) {
    state.velocity = 0.1 * state.position;
    state.velocity.row(0).setZero();
  }
  simulation.restore(snapshot);
  const GoalValues none = [](const Simulation&) { return std::vector<Goal>(); };
  MotionAccuracyState state;
  state.scales = pilot_run(simulation, end, none, [] { return true; })->scales;
  while (!simulation.reached(end)) {
    choose_step(simulation, {1e-2, end / 16.0, end}, none, state);
    ASSERT_EQ(simulation.step(end), StepStatus::accepted);
    note_step(simulation, state);
  }
  EXPECT_EQ(state.bounding.blocks, std::vector<int>{1});
  EXPECT_GT(state.bounding.gain, 2.0);
  EXPECT_GT(state.shortest_step, 0.0);
}

}  // namespace
}  // namespace ashlar::island_errors_test
