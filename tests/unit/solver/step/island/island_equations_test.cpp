#include "solver/step/island/island_equations.hpp"

#include <gtest/gtest.h>

#include "unit/solver/step/sample_problem.hpp"

namespace ashlar::island_equations_test {
namespace {

TEST(IslandProblem, ContactsAreFollowedOnceUntilBlocksMoveOn) {
  test_support::SampleProblem sample(JointLaw{1e9, 1e9, 0.1, 0.0, 0.0, true},
                                     {test_support::level_point({0, 0, 0}, -1e-6)});
  IslandProblem& problem = sample.problem;
  const BlockModel& cube = sample.cube;
  const auto move_on = [&](double along, double turn) {
    const Eigen::Matrix3d gradient =
        Eigen::AngleAxisd(turn, Vector3::UnitY()).toRotationMatrix() - Eigen::Matrix3d::Identity();
    problem.apply(cube.space().restrict(cube.basis().linear_field({along, 0, 0}, gradient)), 1.0);
    problem.respond();
  };
  // The error of rows is slip times rotation.
  constexpr double tolerance = 1e-5;
  move_on(1e-2, 0.0);
  EXPECT_FALSE(problem.follow_contacts(tolerance)) << "it has not turned";
  move_on(0.0, -1e-2);  // the corner goes down
  EXPECT_TRUE(problem.follow_contacts(tolerance));
  EXPECT_FALSE(problem.follow_contacts(tolerance)) << "nothing has moved since";
  move_on(1e-2, 0.0);
  EXPECT_TRUE(problem.follow_contacts(tolerance)) << "it has slipped since";
  EXPECT_FALSE(problem.follow_contacts(tolerance));
}

}  // namespace
}  // namespace ashlar::island_equations_test
