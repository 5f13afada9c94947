#include "mechanics/contact/laws/softened_point.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/check_derivatives.hpp"
#include "unit/mechanics/contact/laws/sample_joint.hpp"

namespace ashlar::softened_point_test {
namespace {

using test_support::left_out;

// T A = 2000 N at w0 = 1e-5 m, lost at wf = 1e-4 m: G_I A = 0.1 J. c A = 3000 N, lost at pf = 3e-4 m: G_II A = 0.45 J.
constexpr double area = 0.1;

JointLaw soft() {
  JointLaw law{2e9, 1e9, 0.5, 3e4, 2e4, true};
  law.fracture = {1.0, 4.5};
  return law;
}

PointLaw soft_point(double damage = 0.0) {
  return point_law(soft(), area, true, damage);
}

TEST(SoftenedPoint, TractionFallsLinearlyWithTheOpeningAndUnloadsAlongTheSecant) {
  const PointLaw point = soft_point();
  EXPECT_DOUBLE_EQ(point_response(point, 0.5e-5, {0, 0}).force[0], -1000.0);
  EXPECT_EQ(point_response(point, 0.5e-5, {0, 0}).damage, 0.0);
  const PointResponse half = point_response(point, 5.5e-5, {0, 0});
  EXPECT_EQ(half.state, ContactState::locked);
  EXPECT_NEAR(half.force[0], -1000.0, 1e-9);
  EXPECT_NEAR(half.damage, 0.5, 1e-15);
  EXPECT_NEAR(half.fractured, 0.05, 1e-15);
  EXPECT_NEAR(half.normal_energy, 0.5 * 1000.0 * 5.5e-5, 1e-15);
  EXPECT_NEAR(point_response(soft_point(0.5), 2.75e-5, {0, 0}).force[0], -500.0, 1e-9);
  EXPECT_NEAR(point_response(soft_point(0.5), -1e-5, {0, 0}).force[0], 2000.0, 1e-9);
  const PointResponse gone = point_response(point, 1.01e-4, {0, 0});
  EXPECT_EQ(gone.state, ContactState::open);
  EXPECT_EQ(gone.damage, 1.0);
  EXPECT_NEAR(gone.fractured, 0.1, 1e-15);
}

TEST(SoftenedPoint, CohesionFallsWithPermanentSlipAndFrictionStays) {
  // Half of the cohesion is left at p = 1.5e-4 m, with an elastic slip of 1500 N/ks = 1.5e-5 m.
  const PointLaw point = soft_point();
  const PointResponse half = point_response(point, 0.0, {1.65e-4, 0});
  EXPECT_EQ(half.state, ContactState::sliding);
  EXPECT_NEAR(half.force[1], -1500.0, 1e-9);
  EXPECT_NEAR(half.damage, 0.5, 1e-14);
  // Integral of 3000 N (1 - p/pf) dp up to pf/2: three quarters of 0.45 J.
  EXPECT_NEAR(1500.0 * 1.5e-4 + half.fractured, 0.75 * 0.45, 1e-14);
  // Under 2000 N friction adds 1000 N: (1500 + 1000) N/ks elastic.
  EXPECT_NEAR(point_response(point, -1e-5, {1.5e-4 + 2.5e-5, 0}).force[1], -2500.0, 1e-9);
  const PointResponse gone = point_response(point, -1e-5, {1e-3, 0});
  EXPECT_NEAR(gone.force[1], -1000.0, 1e-9);
  EXPECT_EQ(gone.damage, 1.0);
  EXPECT_EQ(point_response(point, -1e-5, {3.9e-5, 0}).state, ContactState::locked);
}

TEST(SoftenedPoint, WhatOpensLosesItsCohesionToo) {
  // D = 0.5 by opening, so that 1500 N are left.
  const PointResponse point = point_response(soft_point(), 5.5e-5, {4e-5, 0});
  EXPECT_NEAR(point.force[1], -1500.0, 1e-9);
  EXPECT_NEAR(point.force[0], -1000.0, 1e-9);
}

TEST(SoftenedPoint, TangentAndCouplingAreTheJacobian) {
  const PointLaw point = soft_point(0.1);
  const std::array<Eigen::Vector3d, 8> places = {
      Eigen::Vector3d(5e-6, 1e-6, 0), {5e-5, 1e-6, 2e-6},  {5e-5, 6e-5, 2e-5},  {5e-6, 8e-5, -4e-5},
      {-1e-5, 8e-5, -4e-5},           {-1e-5, 5e-4, 1e-4}, {-1e-5, 1e-5, 1e-5}, {1.5e-5, 1e-4, 1e-4}};
  for (const bool averaged : {false, true}) {
    const Eigen::Vector3d from(2e-6, 1e-6, -1e-6);
    const PointResponse start = point_response(point, from[0], from.tail<2>());
    for (const Eigen::Vector3d& place : places) {
      const auto force = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
        if (averaged) return averaged_step(point, start, from, at).mean.force;
        return point_response(point, at[0], at.tail<2>()).force;
      };
      Eigen::Matrix3d tangent;
      if (averaged) {
        const MeanResponse mean = averaged_step(point, start, from, place).mean;
        // A mean force that falls in tension and slides has no exact coupling.
        if (place[0] > 1e-5 && place[1] > 3e-5) continue;
        tangent = mean.tangent + left_out(mean.coupling);
      } else {
        const PointResponse end = point_response(point, place[0], place.tail<2>());
        tangent = end.tangent + left_out(end.coupling);
      }
      SCOPED_TRACE(::testing::Message() << averaged << ": " << place.transpose());
      // Neither has one that crosses the surface: slip changes the tension before.
      const double tolerance = averaged && place[0] < 0.0 ? 1e-2 : 1e-4;
      test_support::expect_derivative(force, place, -tangent, 1e-10, tolerance);
    }
  }
}

/// Work and damage of a point moved along a straight line in some steps, by mean forces.
struct PulledPoint {
  double work = 0.0;        ///< against its forces, J
  double dissipated = 0.0;  ///< J
  double damage = 0.0;
};

PulledPoint pulled(const JointLaw& law, const Eigen::Vector3d& shift, int steps) {
  PulledPoint result;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (int k = 0; k < steps; ++k) {
    const PointLaw point = point_law(law, area, result.damage < 1.0, result.damage);
    const PointResponse start = point_response(point, place[0], place.tail<2>());
    const Eigen::Vector3d next = place + shift / steps;
    const AveragedStep step = averaged_step(point, start, place, next);
    result.work -= step.mean.force.dot(next - place);
    result.dissipated += step.end.fractured;
    place = next;
    if (step.end.state == ContactState::sliding) {
      place.tail<2>() = elastic_slip(point, step.end, next.tail<2>());
      result.dissipated += step.mean.force.tail<2>().dot(place.tail<2>() - next.tail<2>());
    }
    if (result.damage < 1.0) result.damage = step.end.damage;
  }
  return result;
}

TEST(SoftenedPoint, MeanForcesDoTheWorkOfTheFractureEnergyInAnyNumberOfSteps) {
  JointLaw stiff = soft();
  stiff.normal_stiffness = stiff.shear_stiffness = 1e11;
  // The mean shear force of the step in which slip begins is off by what its spring holds at the strength.
  const double held = 0.5 * 3000.0 * 3000.0 / (stiff.shear_stiffness * area);
  for (const int steps : {1, 2, 5, 50, 500}) {
    const PulledPoint opened = pulled(soft(), {1.5e-4, 0, 0}, steps);
    EXPECT_NEAR(opened.work, 0.1, 1e-12) << steps;
    EXPECT_NEAR(opened.dissipated, 0.1, 1e-12) << steps;
    EXPECT_EQ(opened.damage, 1.0);
    const PulledPoint slid = pulled(stiff, {0, 4e-4, 0}, steps);
    EXPECT_NEAR(slid.work, 0.45, 4.0 * held) << steps;
    EXPECT_NEAR(slid.dissipated, 0.45, 4.0 * held) << steps;
    EXPECT_EQ(slid.damage, 1.0);
  }
}

TEST(SoftenedPoint, MeanForcesAreThoseOfAnElasticBondBelowItsStrength) {
  JointLaw elastic = soft();
  elastic.fracture = {};
  const PointLaw bond = point_law(elastic, area, true);
  const PointLaw point = soft_point();
  const Eigen::Vector3d from(-2e-6, 1e-6, 0), to(3e-6, 4e-6, -2e-6);
  const AveragedStep plain = averaged_step(bond, point_response(bond, from[0], from.tail<2>()), from, to);
  const AveragedStep softened =
      averaged_step(point, point_response(point, from[0], from.tail<2>()), from, to);
  EXPECT_LE((plain.mean.force - softened.mean.force).norm(), 1e-12 * plain.mean.force.norm());
  EXPECT_NEAR(plain.end.energy(), softened.end.energy(), 1e-15);
  EXPECT_EQ(softened.end.damage, 0.0);
}

}  // namespace
}  // namespace ashlar::softened_point_test
