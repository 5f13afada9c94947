#include "solver/step/step_problem.hpp"

#include <gtest/gtest.h>

#include "support/simulations.hpp"

namespace ashlar::step_problem_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::same_law;

/// Two cubes side by side above a base.
BlockSystem two_cubes(const SimulationSettings& settings) {
  std::vector<BlockModel> blocks;
  for (const double x : {0.0, 3.0})
    blocks.emplace_back(
        block_of("cube", Polyhedron(make_box({x, 0, 5}, {x + 1, 1, 6})), {2000, 1e9, 0.25}, 1));
  blocks.emplace_back(fixed_box({-9, -9, -1}, {9, 9, 0}));
  return {std::move(blocks), same_law({}), settings, {}};
}

RunState at_rest(const BlockSystem& system) {
  RunState state;
  for (const BlockModel& block : system.blocks()) state.states.push_back(block.initial_state());
  return state;
}

Vector3 moved(const BlockSystem& system, const RunState& state, const StepProblem& problem, int block) {
  const PolynomialBasis& basis = system.blocks()[static_cast<std::size_t>(block)].basis();
  const Eigen::MatrixX3d change =
      states_after(system, state, problem)[static_cast<std::size_t>(block)].position -
      state.states[static_cast<std::size_t>(block)].position;
  return change.transpose() * basis.values(basis.centroid());
}

TEST(StepProblem, BlocksInTheAirFallWithTheirVelocity) {
  SimulationSettings settings;
  settings.gravity = {0, 0, -10};
  const BlockSystem system = two_cubes(settings);
  RunState state = at_rest(system);
  state.states[1].velocity = system.blocks()[1].rigid_velocity({4, 0, 2}, Vector3::Zero());
  FactorCache factors(settings.linear_method);
  StepProblem problem;
  ASSERT_EQ(solve(system, state, time_scheme(settings, 0.125), factors, problem), IslandStatus::converged);
  EXPECT_EQ(problem.islands.size(), 2U);
  // x = v t + 1/2 g t^2
  EXPECT_NEAR((moved(system, state, problem, 0) - Vector3(0, 0, -0.078125)).norm(), 0.0, 1e-13);
  EXPECT_NEAR((moved(system, state, problem, 1) - Vector3(0.5, 0, 0.25 - 0.078125)).norm(), 0.0, 1e-13);
  EXPECT_EQ(moved(system, state, problem, 2), Vector3(0, 0, 0)) << "fixed";
  EXPECT_GE(state.log.counts.open_close_iterations, 2U) << "what is done is counted";
}

TEST(StepProblem, NothingOfTheRunChangesBeforeAStepIsAccepted) {
  const SimulationSettings settings;
  const BlockSystem system = two_cubes(settings);
  RunState state = at_rest(system);
  const std::vector<BlockState> before = state.states;
  FactorCache factors(settings.linear_method);
  StepProblem problem;
  ASSERT_EQ(solve(system, state, time_scheme(settings, 1e-2), factors, problem), IslandStatus::converged);
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_EQ(state.states[k].position, before[k].position);
    EXPECT_EQ(state.states[k].velocity, before[k].velocity);
  }
  EXPECT_EQ(state.time(), 0.0);
}

TEST(StepProblem, SmoothAccelerationsAreThoseOfGravityLessDamping) {
  SimulationSettings settings;
  settings.gravity = {0, 0, -10};
  settings.mass_damping = 3.0;
  const BlockSystem system = two_cubes(settings);
  RunState state = at_rest(system);
  state.states[0].velocity = system.blocks()[0].rigid_velocity({1, 0, 0}, Vector3::Zero());
  const std::vector<Eigen::MatrixX3d> accelerations = smooth_accelerations(system, state);
  const PolynomialBasis& basis = system.blocks()[0].basis();
  const Vector3 of_middle = accelerations[0].transpose() * basis.values(basis.centroid());
  EXPECT_NEAR((of_middle - Vector3(-3, 0, -10)).norm(), 0.0, 1e-11);
  EXPECT_TRUE(accelerations[2].isZero(0.0)) << "fixed";
}

TEST(StepProblem, NoSupportMovesWhereNoneIsDriven) {
  const SimulationSettings settings;
  const BlockSystem system = two_cubes(settings);
  EXPECT_TRUE(driven_states(system, at_rest(system), 1e-2).empty());
}

}  // namespace
}  // namespace ashlar::step_problem_test
