// Points that open where they slide, against values by hand (notes/dilation.md).
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "mechanics/contact/laws/joint_law.hpp"
#include "support/check_derivatives.hpp"

namespace ashlar::dilation_test {
namespace {

constexpr double kn = 2e8, ks = 1e8;  // N/m, of 0.1 m^2

JointLaw joint(double friction, double dilation) {
  JointLaw law{2e9, 1e9, friction, 0.0, 0.0, true};
  law.dilation = dilation;
  return law;
}

Eigen::Matrix3d whole(const Eigen::Matrix3d& tangent, const Coupling& coupling) {
  return tangent + coupling.force * coupling.by.transpose();
}

// N = -kn (g - p tan(psi)) and ks (|s| - p) = N tan(phi):  p = (5000 - 1000) / (ks + kn / 8) = 3.2e-5 m.
TEST(Dilation, RaisesTheNormalForceWhereAPointSlides) {
  const PointLaw point = point_law(joint(0.5, 0.25), 0.1, false);
  const PointResponse response = point_response(point, -1e-5, {3e-5, 4e-5});
  EXPECT_EQ(response.state, ContactState::sliding);
  EXPECT_NEAR(response.dilation, 0.25 * 3.2e-5, 1e-17);
  EXPECT_LT((response.force - Eigen::Vector3d(3600, -1080, -1440)).norm(), 1e-9);
  EXPECT_NEAR(response.normal_energy, 0.5 * kn * 1.8e-5 * 1.8e-5, 1e-14);
  EXPECT_LT((elastic_slip(point, response, {3e-5, 4e-5}) - Eigen::Vector2d(1.08e-5, 1.44e-5)).norm(), 1e-17);
  // No dilation without sliding.
  const PointResponse locked = point_response(point, -1e-5, {0.9e-5, 0});
  EXPECT_EQ(locked.state, ContactState::locked);
  EXPECT_EQ(locked.dilation, 0.0);
  EXPECT_NEAR(locked.force[0], 2000.0, 1e-9);
}

// A block that has risen as far as it has slid is where it was pressed: above its old surface.
TEST(Dilation, BearsAboveTheSurfaceAsFarAsItHasSlid) {
  const PointLaw point = point_law(joint(0.5, 0.25), 0.1, false);
  const PointResponse response = point_response(point, 5e-6, {0, 5e-5});
  EXPECT_EQ(response.state, ContactState::sliding);
  EXPECT_LT((response.force - Eigen::Vector3d(1200, 0, -600)).norm(), 1e-9);
  EXPECT_NEAR(response.dilation, 0.25 * 4.4e-5, 1e-17);
  const PointResponse open = point_response(point, 1.26e-5, {0, 5e-5});
  EXPECT_EQ(open.state, ContactState::open);
  EXPECT_EQ(open.dilation, 0.0);
  // No jump where it opens.
  EXPECT_LT(point_response(point, 0.25 * 5e-5 - 1e-15, {0, 5e-5}).force.norm(), 1e-5);
}

TEST(Dilation, ImpulsesCountInItsFriction) {
  PointLaw point = point_law(joint(0.5, 0.25), 0.1, false);
  point.augmented = true;
  for (const double impulse : {700.0, -700.0, 1e4, -1e4}) {
    point.impulse_force = impulse;
    const PointResponse response = point_response(point, -1e-5, {5e-5, 0});
    const double normal = response.force[0];
    const double counts = std::clamp(normal + impulse, 0.0, 2.0 * normal);
    EXPECT_NEAR(normal, 2000.0 + kn * response.dilation, 1e-8) << impulse;
    EXPECT_NEAR(-response.force[1], 0.5 * counts, 1e-8) << impulse;
    EXPECT_NEAR(-response.force[1], ks * (5e-5 - response.dilation / 0.25), 1e-7) << impulse;
  }
}

TEST(Dilation, TangentAndCouplingAreTheDerivative) {
  for (const auto& [friction, dilation] : {std::pair{0.5, 0.25}, {0.5, 0.5}, {1.2, 0.1}}) {
    const PointLaw point = point_law(joint(friction, dilation), 0.1, false);
    for (const Eigen::Vector3d& place : {Eigen::Vector3d(-1e-5, 3e-5, -7e-5), {2e-6, 3e-5, 7e-5}}) {
      const auto force = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        return point_response(point, x[0], x.tail<2>()).force;
      };
      const PointResponse response = point_response(point, place[0], place.tail<2>());
      ASSERT_EQ(response.state, ContactState::sliding);
      test_support::expect_derivative(force, place, -whole(response.tangent, response.coupling), 1e-9, 1e-6);
      EXPECT_LT((response.tangent - response.tangent.transpose()).norm(), 1e-12 * response.tangent.norm());
      EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(response.tangent).eigenvalues()[0], -1e-3);
    }
  }
}

// The held bound is that of friction beyond dilation: then forces are the gradient of a convex function.
TEST(Dilation, HeldBoundsMakeItMonotone) {
  PointLaw point = point_law(joint(0.8, 0.3), 0.1, false);
  const PointResponse coulomb = point_response(point, -1e-5, {3e-5, 4e-5});
  const double held = end_response(point, coulomb, -1e-5).limit;
  EXPECT_NEAR(held, 0.5 * coulomb.force[0], 1e-9);
  point.held_limit = held;
  EXPECT_LT((point_response(point, -1e-5, {3e-5, 4e-5}).force - coulomb.force).norm(), 1e-9);
  std::mt19937_64 random(20261124);
  const auto any = [&] { return 1e-4 * (0x1p-52 * static_cast<double>(random() >> 11U) - 1.0); };
  for (int trial = 0; trial < 2000; ++trial) {
    const Eigen::Vector3d x(any(), any(), any()), y(any(), any(), any());
    const auto force = [&](const Eigen::Vector3d& place) {
      return point_response(point, place[0], place.tail<2>()).force;
    };
    EXPECT_LE((force(x) - force(y)).dot(x - y), 1e-12 * (force(x) - force(y)).norm()) << trial;
  }
  const Eigen::Vector3d place(-1e-5, 3e-5, -7e-5);
  test_support::expect_derivative(
      [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        return point_response(point, x[0], x.tail<2>()).force;
      },
      place, -point_response(point, place[0], place.tail<2>()).tangent, 1e-9, 1e-6);
}

// Sliding by p dissipates (|F| - N tan(psi)) p: never negative while psi <= phi.
TEST(Dilation, MeanForcesTakeWhatSlidingTakesLessWhatItRaises) {
  std::mt19937_64 random(7);
  const auto any = [&](double most) { return most * (0x1p-52 * static_cast<double>(random() >> 11U) - 1.0); };
  int slid = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const double friction = std::abs(any(1.5));
    const PointLaw point = point_law(joint(friction, friction * std::abs(any(1.0))), 0.1, false);
    const double g0 = -std::abs(any(1e-5)), g1 = any(1e-5);
    const Eigen::Vector2d trial_slip(any(1e-5), any(1e-5)), shift(any(3e-5), any(3e-5));
    PointLaw still = point;
    still.dilation = {};
    const PointResponse start = point_response(still, g0, trial_slip);
    const Eigen::Vector2d e0 = elastic_slip(still, start, trial_slip);
    const auto [end, mean] =
        averaged_step(point, start, {g0, e0.x(), e0.y()}, {g1, e0.x() + shift.x(), e0.y() + shift.y()});
    const double work = mean.force[0] * (g1 - g0) + mean.force.tail<2>().dot(shift);
    const double lost = start.energy() - end.energy() - work;
    const double scale = start.energy() + end.energy() + std::abs(work);
    EXPECT_GE(lost, -1e-12 * scale) << trial;
    if (end.state != ContactState::sliding) continue;
    const double slip = (e0 + shift - elastic_slip(point, end, e0 + shift)).norm();
    EXPECT_NEAR(end.dilation, point.dilation.tangent * slip, 1e-12 * slip) << trial;
    EXPECT_NEAR(lost, (mean.force.tail<2>().norm() - point.dilation.tangent * mean.force[0]) * slip,
                1e-9 * scale);
    ++slid;
  }
  EXPECT_GT(slid, 1000);
}

TEST(Dilation, MeanCouplingIsWhatTheMeanTangentLeavesOut) {
  const PointLaw point = point_law(joint(0.5, 0.3), 0.1, false);
  PointLaw still = point;
  still.dilation = {};
  const PointResponse start = point_response(still, -5e-5, {2e-5, 1e-5});
  // Presses on, opens while it slides, is lifted by sliding.
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(-1e-5, 9e-5, -7e-5), {6e-5, 9e-5, 3e-4}, {2e-5, 3e-4, 1e-4}}) {
    const auto mean = [&](const Eigen::Vector3d& x) {
      return averaged_step(point, start, {-5e-5, 2e-5, 1e-5}, x).mean;
    };
    test_support::expect_derivative(
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return mean(x).force; }, place,
        -whole(mean(place).tangent, mean(place).coupling), 1e-9, 1e-5);
  }
}

// A point that is open at the start and lands: it dilates in the share of the step in which it is closed.
TEST(Dilation, ALandingPointDilatesWhileItIsClosed) {
  PointLaw point = point_law(joint(0.5, 0.25), 0.1, false);
  point.dilation.landing_from = 1e-5;
  const PointResponse start = point_response(point_law(joint(0.5, 0.0), 0.1, false), 1e-5, {0, 0});
  for (const double depth : {1e-6, 1e-5, 9e-5}) {
    const double share = depth / (depth + 1e-5);
    const PointResponse end = point_response(point, -depth, {3e-4, 0});
    EXPECT_NEAR(end.dilation, 0.25 * share * (3e-4 + end.force[1] / ks), 1e-12) << depth;
    EXPECT_NEAR(end.force[0], kn * (depth + end.dilation), 1e-6) << depth;
    const Eigen::Vector3d place(-depth, 3e-4, 1e-5);
    const PointResponse at = point_response(point, place[0], place.tail<2>());
    test_support::expect_derivative(
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
          return point_response(point, x[0], x.tail<2>()).force;
        },
        place, -whole(at.tangent, at.coupling), 1e-10, 1e-5);
    const auto mean = [&](const Eigen::Vector3d& x) {
      return averaged_step(point, start, {1e-5, 0, 0}, x).mean;
    };
    test_support::expect_derivative(
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return mean(x).force; }, place,
        -whole(mean(place).tangent, mean(place).coupling), 1e-10, 1e-5);
  }
  EXPECT_EQ(point_response(point, 1e-7, {3e-4, 0}).state, ContactState::open);
}

}  // namespace
}  // namespace ashlar::dilation_test
