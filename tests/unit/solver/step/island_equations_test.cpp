#include "solver/step/island_equations.hpp"

#include <gtest/gtest.h>

#include "support/simulations.hpp"

namespace ashlar {
namespace {

/// The field of a velocity v + w x (X - c) as a change of the position's coefficients.
Eigen::MatrixX3d rigid_field(const BlockModel& block, const Vector3& along, const Vector3& turn) {
  const Eigen::VectorXd motion =
      block.basis().rigid_motions(1.0) * (Eigen::VectorXd(6) << along, turn).finished();
  return motion.reshaped(block.basis().size(), 3);
}

TEST(IslandProblem, ContactsAreFollowedOnceUntilBlocksMoveOn) {
  const BlockModel cube(
      test_support::block_of("cube", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2500, 1e9, 0.2}, 1));
  const BlockModel ground(test_support::fixed_box({-2, -2, -1}, {3, 3, 0}));
  const BlockState at_rest = cube.initial_state(), of_ground = ground.initial_state();
  ContactPoint point{};
  point.face_a = point.face_b = 0;
  point.material_a = point.material_b = point.place_a = point.place_b = Vector3::Zero();
  point.normal = Vector3::UnitZ();
  point.tangent_1 = Vector3::UnitX();
  point.tangent_2 = Vector3::UnitY();
  point.area = 1.0;
  point.gap = -1e-6;
  const std::vector<ContactPair> pairs = {{{0, 1, {&cube, &at_rest, nullptr}, {&ground, &of_ground, nullptr}},
                                           JointLaw{1e9, 1e9, 0.1, 0.0, 0.0, true},
                                           {point},
                                           {{}}}};
  std::vector<BodyStep> bodies(2);
  for (BodyStep& body : bodies) {
    body.model = &body == bodies.data() ? &cube : &ground;
    body.state = &body == bodies.data() ? &at_rest : &of_ground;
    body.free_change = body.external_force = body.change = Eigen::VectorXd::Zero(body.model->unknowns());
  }
  const Island island{{0}, {0}};
  IslandSolvers solvers;
  SimulationSettings settings;
  IslandProblem problem(island, bodies, pairs, time_scheme(settings, 1e-3), settings,
                        solver_of(island, bodies, pairs, SystemRole::step, solvers));
  const auto move_on = [&](double along, double turn) {
    problem.apply(cube.space().restrict(rigid_field(cube, {along, 0, 0}, {0, turn, 0})), 1.0);
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
