#include "mechanics/contact/laws/joint_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/check_derivatives.hpp"
#include "unit/mechanics/contact/laws/sample_joint.hpp"

namespace ashlar::joint_law_test {
namespace {

using test_support::law;
using test_support::left_out;

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

TEST(JointLaw, WhatHasFailedHasItsResidualStrength) {
  JointLaw weak = law;
  weak.residual = ResidualStrength{0.25, 1e4, 5e3};
  PointLaw point = point_law(weak, 0.1, true);
  EXPECT_TRUE(point.weakens());
  point.fail();
  const PointLaw failed = point_law(weak, 0.1, false);
  // N = 2000 N: 0.25 N + 1e4 Pa * 0.1 m^2 = 1500 N at a slip of 1.5e-5 m, tension 500 N at a gap of 2.5e-6 m.
  for (const PointLaw& left : {point, failed}) {
    EXPECT_FALSE(left.weakens());
    EXPECT_EQ(point_response(left, -1e-5, {1.49e-5, 0}).state, ContactState::locked);
    EXPECT_NEAR(point_response(left, -1e-5, {5e-5, 0}).force[1], -1500.0, 1e-9);
    EXPECT_NEAR(point_response(left, 2.4e-6, {0, 0}).force[0], -480.0, 1e-9);
    EXPECT_EQ(point_response(left, 2.6e-6, {0, 0}).state, ContactState::open);
  }
  // Without residual values friction is kept, the rest is lost.
  PointLaw brittle = point_law(law, 0.1, true);
  brittle.fail();
  EXPECT_EQ(brittle.friction, 0.5);
  EXPECT_EQ(brittle.cohesion, 0.0);
  EXPECT_EQ(brittle.tension, 0.0);
  // Tension alone is not lost by sliding.
  EXPECT_TRUE(point_law(law, 0.1, true).weakens_by_sliding());
  const PointLaw glued = point_law({2e9, 1e9, 0.5, 0.0, 2e4, true}, 0.1, true);
  EXPECT_TRUE(glued.weakens());
  EXPECT_FALSE(glued.weakens_by_sliding());
  // Perfectly plastic: nothing to lose.
  weak.residual = ResidualStrength{0.5, 3e4, 2e4};
  EXPECT_FALSE(point_law(weak, 0.1, true).weakens());
}

TEST(JointLaw, TensionThatCannotFailYieldsInStatics) {
  JointLaw plastic = law;
  plastic.residual = ResidualStrength{0.5, 3e4, 2e4};
  PointLaw point = point_law(plastic, 0.1, true);  // T A = 2000 N at kn A = 2e8 N/m: 1e-5 m; c A = 3000 N
  EXPECT_EQ(point_response(point, 3e-5, {0, 0}).state, ContactState::open);
  point.is_static = true;
  EXPECT_TRUE(point.yields());
  EXPECT_DOUBLE_EQ(point_response(point, 0.5e-5, {0, 0}).force[0], -1000.0);
  EXPECT_EQ(point_response(point, 0.5e-5, {0, 0}).tangent(0, 0), 2e8);
  const PointResponse far = point_response(point, 3e-5, {2e-5, 0});
  EXPECT_EQ(far.state, ContactState::locked);
  EXPECT_DOUBLE_EQ(far.force[0], -2000.0);
  EXPECT_NEAR(far.force[1], -2000.0, 1e-9);
  EXPECT_EQ(far.tangent(0, 0), 0.0);
  // 2000 N over 1e-5 m, half of it, and over the remaining 2e-5 m.
  EXPECT_NEAR(far.normal_energy, 0.01 + 0.04, 1e-15);
  // Shear is bounded by cohesion, as without pressure.
  EXPECT_NEAR(point_response(point, 3e-5, {5e-5, 0}).force[1], -3000.0, 1e-9);
  // Strength that can fail does not yield, what is left of it does.
  plastic.residual->tensile_strength = 1e4;
  PointLaw weak = point_law(plastic, 0.1, true);
  weak.is_static = true;
  EXPECT_FALSE(weak.yields());
  EXPECT_EQ(point_response(weak, 3e-5, {0, 0}).state, ContactState::open);
  weak.fail();
  EXPECT_DOUBLE_EQ(point_response(weak, 3e-5, {0, 0}).force[0], -1000.0);
  // Without residual strength a failed point opens.
  PointLaw brittle = point_law(law, 0.1, false);
  brittle.is_static = true;
  EXPECT_FALSE(brittle.yields());
  EXPECT_EQ(point_response(brittle, 1e-6, {0, 0}).state, ContactState::open);
}

TEST(JointLaw, RoundingDoesNotChooseTheState) {
  JointLaw rounded = law;
  rounded.rounding = 1e-14;
  const PointLaw point = point_law(rounded, 0.1, false);
  // In touch but for rounding: closed, without force.
  for (const double gap : {-0.9e-14, 0.0, 0.9e-14}) {
    const PointResponse touching = point_response(point, gap, {0, 0});
    EXPECT_EQ(touching.state, ContactState::locked) << gap;
    EXPECT_EQ(touching.force[0], std::max(0.0, -2e8 * gap));
    EXPECT_EQ(touching.tangent(0, 0), 2e8);
    EXPECT_EQ(touching.tangent(1, 1), 1e8);
  }
  EXPECT_EQ(point_response(point, 1.1e-14, {0, 0}).state, ContactState::open);
  // At the limit of 1000 N but for rounding: locked, with the force of the limit.
  for (const double slip : {1e-5 - 0.9e-14, 1e-5, 1e-5 + 0.9e-14}) {
    const PointResponse held = point_response(point, -1e-5, {slip, 0});
    EXPECT_EQ(held.state, ContactState::locked) << slip;
    EXPECT_DOUBLE_EQ(held.force[1], -std::min(1000.0, 1e8 * slip));
  }
  EXPECT_EQ(point_response(point, -1e-5, {1e-5 + 1.1e-14, 0}).state, ContactState::sliding);
  // Cohesion acts in touch, and as long as the gap may be rounding.
  const PointLaw intact =
      point_law({2e9, 1e9, 0.5, 3e4, 0.0, true, Transmission::by_scene, 1e-14}, 0.1, true);
  for (const double gap : {-0.9e-14, 0.9e-14})
    EXPECT_NEAR(point_response(intact, gap, {1e-6, 0}).force[1], -100.0, 1e-9);
  // A point in contact slides below its limit, with a known gain of friction under pressure.
  for (const double gap : {-0.5e-14, 0.0, 0.5e-14}) {
    const PointResponse sliding = point_response(point, gap, {3e-5, 0});
    EXPECT_EQ(sliding.state, ContactState::sliding);
    EXPECT_EQ(sliding.coupling.force, Eigen::Vector3d(0, -0.5 * 2e8, 0)) << gap;
  }
  const PointResponse apart = point_response(point, 1.1e-14, {3e-5, 0});
  EXPECT_EQ(apart.state, ContactState::open);
}

TEST(JointLaw, ABridgedPointKeepsItsCohesionAcrossAGap) {
  PointLaw point = point_law({2e9, 1e9, 0.5, 3e4, 0.0, true}, 0.1, true);  // c A = 3000 N, ks A = 1e8 N/m
  point.bridged = true;
  const PointResponse held = point_response(point, 1e-3, {0, 2e-5});
  EXPECT_EQ(held.state, ContactState::locked);
  EXPECT_LT((held.force - Eigen::Vector3d(0, 0, -2000)).norm(), 1e-9);
  EXPECT_EQ(held.tangent(0, 0), 0.0);
  const PointResponse sliding = point_response(point, 1e-3, {0, 5e-5});
  EXPECT_EQ(sliding.state, ContactState::sliding);
  EXPECT_LT((sliding.force - Eigen::Vector3d(0, 0, -3000)).norm(), 1e-9);
  EXPECT_TRUE(sliding.coupling.force.isZero(0.0));
  // No jump where it opens.
  const Eigen::Vector3d closed = point_response(point, -1e-15, {0, 5e-5}).force;
  EXPECT_LT((point_response(point, 1e-15, {0, 5e-5}).force - closed).norm(), 1e-5);
  // Nor over a step that starts in touch, where an open end would else leave it closed for no share of the
  // step.
  const PointResponse touching = point_response(point, 0.0, {0, 0});
  for (const double gap : {-1e-15, 1e-15, 1e-3}) {
    const AveragedStep step = averaged_step(point, touching, {0, 0, 0}, {gap, 0, 8e-5});
    EXPECT_LT((step.mean.force - Eigen::Vector3d(0, 0, -3000)).norm(), 1e-5) << gap;
  }
  point.bridged = false;
  EXPECT_EQ(point_response(point, 1e-15, {0, 5e-5}).state, ContactState::open);
  EXPECT_EQ(averaged_step(point, touching, {0, 0, 0}, {1e-15, 0, 8e-5}).mean.force, Eigen::Vector3d(0, 0, 0));
}

TEST(JointLaw, WhatHasNoFrictionIsNeverLocked) {
  const PointLaw smooth =
      point_law({2e9, 1e9, 0.0, 0.0, 0.0, true, Transmission::by_scene, 1e-14}, 0.1, true);
  for (const double slip : {0.9e-14, 1e-5}) {
    const PointResponse response = point_response(smooth, -1e-5, {slip, 0});
    EXPECT_EQ(response.state, ContactState::sliding);
    EXPECT_TRUE(response.force.tail<2>().isZero(0.0));
    EXPECT_TRUE((response.tangent.bottomRightCorner<2, 2>().isZero(0.0)));
  }
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
          return Eigen::VectorXd::Constant(1, point_response(point, x[0], x.tail<2>()).energy());
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

TEST(JointLaw, CouplingIsWhatTheTangentLeavesOut) {
  const PointLaw point = point_law(law, 0.1, false);
  const Eigen::Vector3d place(-1e-5, 3e-5, -7e-5);
  const PointResponse response = point_response(point, place[0], place.tail<2>());
  Eigen::Matrix3d whole = response.tangent;
  whole += left_out(response.coupling);
  test_support::expect_derivative(
      [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        return point_response(point, x[0], x.tail<2>()).force;
      },
      place, -whole, 1e-9, 1e-6);
  const PointResponse locked = point_response(point, -1e-5, {1e-6, 0});
  EXPECT_TRUE(locked.coupling.force.isZero(0.0));
}

TEST(JointLaw, AHeldLimitActsWhateverTheNormalForce) {
  PointLaw point = point_law(law, 0.1, false);
  point.held_limit = 100.0;  // N, at ks A = 1e8 N/m reached at 1e-6 m
  for (const double gap : {-1e-5, 1.0}) {
    const PointResponse sliding = point_response(point, gap, {3e-5, 4e-5});
    EXPECT_EQ(sliding.state, ContactState::sliding);
    EXPECT_NEAR(sliding.force[0], gap < 0.0 ? 2000.0 : 0.0, 1e-9);
    EXPECT_NEAR(sliding.force[1], -60.0, 1e-12);
    EXPECT_NEAR(sliding.force[2], -80.0, 1e-12);
    EXPECT_TRUE(sliding.coupling.force.isZero(0.0));
    const PointResponse locked = point_response(point, gap, {0.9e-6, 0});
    EXPECT_EQ(locked.state, ContactState::locked);
    EXPECT_NEAR(locked.force[1], -90.0, 1e-12);
  }
  point.held_limit = 0.0;
  EXPECT_EQ(point_response(point, 1.0, {3e-5, 4e-5}).state, ContactState::open);
}

TEST(JointLaw, MultipliersAddToTheSprings) {
  PointLaw point = point_law(law, 0.1, false);
  point.augmented = true;
  point.normal_multiplier = 500.0;
  point.shear_multiplier = {200.0, 0.0};
  // N = 500 + 2000 N, limit 1250 N; shear 200 - 1e8 * 1e-6 = 100 N.
  const PointResponse locked = point_response(point, -1e-5, {1e-6, 0});
  EXPECT_EQ(locked.state, ContactState::locked);
  EXPECT_NEAR(locked.force[0], 2500.0, 1e-9);
  EXPECT_NEAR(locked.force[1], 100.0, 1e-9);
  // N = 500 - 400 N across a gap of 2e-6 m.
  EXPECT_NEAR(point_response(point, 2e-6, {1.5e-6, 0}).force[0], 100.0, 1e-9);
  EXPECT_EQ(point_response(point, 2.6e-6, {0, 0}).state, ContactState::open);
  const Eigen::Vector2d far(-5e-5, 0.0);
  const PointResponse sliding = point_response(point, -1e-5, far);
  EXPECT_EQ(sliding.state, ContactState::sliding);
  EXPECT_NEAR(sliding.force[1], 1250.0, 1e-9);
  EXPECT_EQ(sliding.energy() + locked.energy(), 0.0);
  EXPECT_TRUE(elastic_slip(point, sliding, far).isZero(0.0));
  EXPECT_TRUE(elastic_slip(point, locked, {1e-6, 0}).isZero(0.0));
}

TEST(JointLaw, ImpulsesCountInTheBoundOfTheShearForceAsFarAsTheNormalForceGoes) {
  PointLaw point = point_law(law, 0.1, false);
  point.augmented = true;
  const Eigen::Vector2d far(-5e-5, 0.0);
  const double normal = 2000.0, gap = -1e-5;
  for (const auto& [impulse, counts] :
       {std::array{300.0, 2300.0}, {-300.0, 1700.0}, {5000.0, 4000.0}, {-2500.0, 0.0}}) {
    point.impulse_force = impulse;
    const PointResponse sliding = point_response(point, gap, far);
    EXPECT_EQ(sliding.state, ContactState::sliding) << impulse;
    EXPECT_NEAR(sliding.force[0], normal, 1e-9);
    EXPECT_NEAR(sliding.force[1], law.friction * counts, 1e-9) << impulse;
    // By a force of 1e-3 N more.
    const double less = 1e-3 / point.normal_stiffness;
    const double change = point_response(point, gap - less, far).force[1] - sliding.force[1];
    EXPECT_NEAR(change, less * sliding.coupling.force[1], 1e-8) << impulse;
  }
  // No friction without pressure.
  EXPECT_EQ(point_response(point, 0.0, far).force[1], 0.0);
}

TEST(JointLaw, CohesionBearsSlipOnBothSidesOfTheSurface) {
  const PointLaw point =
      point_law({2e9, 1e9, 0.5, 1e4, 0.0, true}, 0.1, true);  // c A = 1000 N, ks A = 1e8 N/m
  EXPECT_NEAR(borne_slip(point, 0.0, {3e-5, 4e-5})[1], 8e-6, 1e-18);
  EXPECT_NEAR(borne_slip(point, 2000.0, {3e-5, 4e-5})[1], 1.6e-5, 1e-18);
  EXPECT_EQ(borne_slip(point, 0.0, {6e-6, 0}), Eigen::Vector2d(6e-6, 0));
  const PointLaw broken = point_law({2e9, 1e9, 0.5, 1e4, 0.0, true}, 0.1, false);
  EXPECT_TRUE(borne_slip(broken, 0.0, {3e-5, 4e-5}).isZero(0.0));
}

}  // namespace
}  // namespace ashlar::joint_law_test
