#include "solver/step/solve/proximal_guess.hpp"

#include <gtest/gtest.h>

#include "unit/solver/step/sample_problem.hpp"

namespace ashlar::proximal_guess_test {
namespace {

using test_support::level_point;
using test_support::SampleProblem;

// A cube lands on three corners, and slides: three springs of 1e9 N/m are as stiff as its inertia over the step, 2500 kg /
// (1 ms)^2, so that it sinks in by about half of its way down, and shear springs would bear a quarter of its way along or
// more, 4e4 N, where friction of 0.1 bears 1e4 to 2e4 N.
TEST(ProximalGuess, IsNearBalanceUnderTheTrueLaw) {
  SampleProblem sample(JointLaw{1e9, 5e8, 0.1, 0.0, 0.0, true},
                       {level_point({0, 0, 0}, 1e-6), level_point({1, 0, 0}, 1e-6),
                        level_point({1, 1, 0}, 2e-6), level_point({0, 1, 0}, 5e-3)});
  sample.bodies[0].free_change = sample.cube.space().restrict(
      sample.cube.basis().linear_field({3e-4, 1e-4, -4e-4}, Eigen::Matrix3d::Zero()));
  IslandProblem& problem = sample.problem;
  problem.predict(Predictor::inertial);
  problem.respond();
  const double before = problem.residual().largest_by_force;
  EXPECT_GT(before, 0.5);
  IslandTangent tangent(problem);
  ASSERT_TRUE(take_proximal_guess(problem, tangent));
  const double after = problem.residual().largest_by_force;
  EXPECT_LT(after, 0.1);
  const std::vector<ContactState> states = problem.states();
  EXPECT_EQ(states[0], ContactState::sliding);
  EXPECT_EQ(states[3], ContactState::open);
}

TEST(ProximalGuess, IsNotTakenInPlaceOfABetterOne) {
  SampleProblem sample(JointLaw{1e9, 5e8, 0.5, 0.0, 0.0, true}, {level_point({0.5, 0.5, 0}, 0.0)});
  IslandProblem& problem = sample.problem;
  problem.predict(Predictor::at_rest);
  problem.respond();
  ASSERT_EQ(problem.residual().largest, 0.0);  // without forces
  IslandTangent tangent(problem);
  EXPECT_FALSE(take_proximal_guess(problem, tangent));
  EXPECT_EQ(problem.guess()[0].norm(), 0.0);
  EXPECT_EQ(problem.residual().largest, 0.0);
}

}  // namespace
}  // namespace ashlar::proximal_guess_test
