#include "solver/step/island_equations.hpp"

#include <gtest/gtest.h>

#include "support/simulations.hpp"
#include "unit/solver/contact/sample_pair.hpp"

namespace ashlar {
namespace {

TEST(IslandProblem, ContactsAreFollowedOnceUntilBlocksMoveOn) {
  const BlockModel cube(
      test_support::block_of("cube", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2500, 1e9, 0.2}, 1));
  const BlockModel ground(test_support::fixed_box({-2, -2, -1}, {3, 3, 0}));
  const BlockState at_rest = cube.initial_state(), of_ground = ground.initial_state();
  const std::vector<ContactPair> pairs = {{{0, 1, {&cube, &at_rest, nullptr}, {&ground, &of_ground, nullptr}},
                                           JointLaw{1e9, 1e9, 0.1, 0.0, 0.0, true},
                                           {test_support::level_point({0, 0, 0}, -1e-6)},
                                           {{}}}};
  std::vector<BodyStep> bodies(2);
  for (BodyStep& body : bodies) {
    body.model = &body == bodies.data() ? &cube : &ground;
    body.state = &body == bodies.data() ? &at_rest : &of_ground;
    body.free_change = body.external_force = body.change = Eigen::VectorXd::Zero(body.model->unknowns());
  }
  const Island island{{0}, {0}};
  IslandSolvers solvers{LinearMethod::cholesky};
  SimulationSettings settings;
  IslandProblem problem(island, bodies, pairs, time_scheme(settings, 1e-3), settings,
                        solver_of(island, bodies, pairs, SystemRole::step, solvers));
  const auto move_on = [&](double along, double turn) {
    const Eigen::Matrix3d gradient =
        Eigen::AngleAxisd(turn, Vector3::UnitY()).toRotationMatrix() - Eigen::Matrix3d::Identity();
    problem.apply(cube.space().restrict(cube.basis().linear_field({along, 0, 0}, gradient)), 1.0);
    problem.respond();
  };
  // What rows leave out is slip times turn.
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
}  // namespace ashlar
