#include "mechanics/joint_law.hpp"

#include <gtest/gtest.h>

#include "support/check_derivatives.hpp"

namespace ashlar {
namespace {

const JointLaw law{2e9, 1e9, 0.5, 3e4, 2e4, true};

TEST(JointLaw, OpensByGapOrTension) {
  const PointLaw failed = point_law(law, 0.1, false);
  EXPECT_EQ(point_response(failed, 1e-12, {0, 0}).state, ContactState::open);
  EXPECT_EQ(point_response(failed, 0.0, {0, 0}).state, ContactState::locked);
  const PointLaw intact = point_law(law, 0.1, true);  // T A = 2000 N at kn A = 2e8 N/m: 1e-5 m
  EXPECT_EQ(point_response(intact, 0.99e-5, {0, 0}).state, ContactState::locked);
  EXPECT_DOUBLE_EQ(point_response(intact, 0.5e-5, {0, 0}).force[0], -1000.0);
  EXPECT_EQ(point_response(intact, 1.01e-5, {0, 0}).state, ContactState::open);
}

TEST(JointLaw, SlidesAtTheCoulombLimit) {
  const PointLaw point = point_law(law, 0.1, false);
  // N = 2e8 * 1e-5 = 2000 N, limit 1000 N, reached at a slip of 1000 / 1e8 = 1e-5 m.
  EXPECT_EQ(point_response(point, -1e-5, {0.99e-5, 0}).state, ContactState::locked);
  const Eigen::Vector2d slip(3e-5, 4e-5);
  const PointResponse sliding = point_response(point, -1e-5, slip);
  EXPECT_EQ(sliding.state, ContactState::sliding);
  EXPECT_NEAR(sliding.force[1], -600.0, 1e-9);
  EXPECT_NEAR(sliding.force[2], -800.0, 1e-9);
  EXPECT_LT((elastic_slip(point, sliding, slip) - Eigen::Vector2d(0.6e-5, 0.8e-5)).norm(), 1e-18);
  const PointLaw intact = point_law(law, 0.1, true);  // cohesion adds 3000 N
  EXPECT_EQ(point_response(intact, -1e-5, {3.99e-5, 0}).state, ContactState::locked);
  EXPECT_EQ(point_response(intact, -1e-5, {4.01e-5, 0}).state, ContactState::sliding);
}

TEST(JointLaw, PointSpringsDoNotScaleWithArea) {
  JointLaw per_point = law;
  per_point.area_springs = false;
  EXPECT_DOUBLE_EQ(point_law(per_point, 0.1, false).normal_stiffness, 2e9);
  EXPECT_DOUBLE_EQ(point_law(law, 0.1, false).normal_stiffness, 2e8);
}

TEST(JointLaw, ForcesAreDerivativesOfTheEnergyAndTangentsOfTheForces) {
  const PointLaw point = point_law(law, 0.1, false);
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(-2e-5, 0.4e-5, -0.3e-5), Eigen::Vector3d(-1e-6, 0, 0)}) {
    const PointResponse response = point_response(point, place[0], place.tail<2>());
    ASSERT_EQ(response.state, ContactState::locked);
    test_support::expect_derivative(
        [&](const Eigen::VectorXd& x) {
          return Eigen::VectorXd::Constant(1, point_response(point, x[0], x.tail<2>()).energy);
        },
        place, -response.force.transpose(), 1e-9, 1e-6);
    test_support::expect_derivative(
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
          return point_response(point, x[0], x.tail<2>()).force;
        },
        place, -response.tangent, 1e-9, 1e-6);
  }
}

TEST(JointLaw, SlidingTangentIsTheDerivativeAtConstantNormalForce) {
  const PointLaw point = point_law(law, 0.1, false);
  const Eigen::Vector2d slip(3e-5, -7e-5);
  const PointResponse response = point_response(point, -1e-5, slip);
  test_support::expect_derivative(
      [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        return point_response(point, -1e-5, x).force.tail<2>();
      },
      slip, -response.tangent.bottomRightCorner<2, 2>(), 1e-9, 1e-6);
}

TEST(JointLaw, MeanForceDoesExactlyTheWorkOfTheSpring) {
  const PointLaw point = point_law(law, 0.1, false);
  for (const auto& [g0, g1] :
       {std::pair{1e-4, -3e-5}, {-3e-5, 1e-4}, {-2e-5, -7e-5}, {1e-4, 2e-4}, {0.0, -1e-5}}) {
    const PointResponse start = point_response(point, g0, {0, 0});
    const PointResponse end = point_response(point, g1, {0, 0});
    const MeanResponse mean = mean_response(point, start, g0, end, g1);
    EXPECT_NEAR(mean.force[0] * (g1 - g0), start.energy - end.energy, 1e-12 * (start.energy + end.energy));
    const double from = g0;
    test_support::expect_derivative(
        [&](const Eigen::VectorXd& x) {
          return Eigen::VectorXd::Constant(
              1, mean_response(point, start, from, point_response(point, x[0], {0, 0}), x[0]).force[0]);
        },
        Eigen::VectorXd::Constant(1, g1), Eigen::MatrixXd::Constant(1, 1, -mean.tangent(0, 0)), 1e-9, 1e-5);
    EXPECT_GE(mean.tangent(0, 0), 0.0);
  }
}

}  // namespace
}  // namespace ashlar
