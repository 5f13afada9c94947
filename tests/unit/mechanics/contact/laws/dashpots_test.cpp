// Dashpots beside the springs of a point, against values by hand (notes/joint_damping.md).
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mechanics/contact/laws/joint_law.hpp"
#include "support/check_derivatives.hpp"

namespace ashlar::dashpots_test {
namespace {

/// kn = 2e8 N/m, ks = 1e8 N/m, dashpots of half of them over the step.
PointLaw damped(double start_gap, const Eigen::Vector2d& start_slip, double friction = 0.5) {
  PointLaw point = point_law({2e9, 1e9, friction, 0.0, 0.0, true}, 0.1, false);
  point.dashpots = {1e8, 5e7, start_gap, start_slip};
  return point;
}

TEST(Dashpots, PushWhereThePointIsPressedFarther) {
  const PointResponse response = point_response(damped(-1e-5, {0, 0}), -2e-5, {0, 0});
  EXPECT_NEAR(response.force[0], 4000.0 + 1000.0, 1e-9);
  EXPECT_NEAR(response.damped, 1000.0 * 1e-5, 1e-15);
  EXPECT_NEAR(response.normal_energy, 0.5 * 2e8 * 4e-10, 1e-15);
  // From above they act below the surface only.
  const PointResponse landed = point_response(damped(1e-4, {0, 0}), -1e-5, {0, 0});
  EXPECT_NEAR(landed.force[0], 2000.0 + 1000.0, 1e-9);
  EXPECT_NEAR(landed.damped, 1000.0 * 1.1e-4, 1e-15);
}

// 400 N of the spring are less than the 800 N that the dashpot would pull with.
TEST(Dashpots, NeverPull) {
  const PointResponse response = point_response(damped(-1e-5, {0, 0}), -2e-6, {0, 0});
  EXPECT_EQ(response.state, ContactState::open);
  EXPECT_TRUE(response.force.isZero(0.0));
  // The energy still in the spring is not lost yet.
  EXPECT_NEAR(response.normal_energy, 0.5 * 2e8 * 4e-12, 1e-18);
  EXPECT_NEAR(response.damped, 400.0 * 8e-6, 1e-15);
  // Bonds do bear that.
  PointLaw bond = damped(-1e-5, {0, 0});
  bond.tension = 1e4;
  EXPECT_NEAR(point_response(bond, -2e-6, {0, 0}).force[0], -400.0, 1e-9);
}

// Before the slider: spring and dashpot share the force that slides, (ks + c) e1 = L + c e0.
TEST(Dashpots, AreBeforeTheSlider) {
  const PointLaw point = damped(-1e-5, {0.4e-5, 0});
  const PointResponse locked = point_response(point, -1e-5, {0.6e-5, 0});
  EXPECT_EQ(locked.state, ContactState::locked);
  EXPECT_NEAR(locked.force[1], -600.0 - 100.0, 1e-9);
  EXPECT_NEAR(locked.damped, 5e7 * 4e-12, 1e-15);
  const PointResponse sliding = point_response(point, -1e-5, {5e-5, 0});
  EXPECT_EQ(sliding.state, ContactState::sliding);
  EXPECT_NEAR(sliding.force[1], -1000.0, 1e-9);
  EXPECT_NEAR(elastic_slip(point, sliding, {5e-5, 0})[0], 0.8e-5, 1e-17);
  EXPECT_NEAR(sliding.shear_energy, 0.5 * 1e8 * 0.64e-10, 1e-15);
}

TEST(Dashpots, TangentsAreDerivatives) {
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(-2e-5, 1e-6, 2e-6), {-2e-5, 3e-5, -7e-5}, {-3e-5, 3e-5, -7e-5}}) {
    for (const double dilation : {0.0, 0.3}) {
      PointLaw point = damped(-1e-5, {0.2e-5, 0});
      point.dilation.tangent = dilation;
      const PointResponse response = point_response(point, place[0], place.tail<2>());
      const Coupling coupling = response.coupling;
      const auto force = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        return point_response(point, x[0], x.tail<2>()).force;
      };
      test_support::expect_derivative(
          force, place, -(response.tangent + coupling.force * coupling.by.transpose()), 1e-9, 1e-6);
      PointLaw plain = point;
      plain.dashpots = {};
      plain.dilation = {};
      const PointResponse start = point_response(plain, -1e-5, {0.2e-5, 0});
      const auto mean = [&](const Eigen::Vector3d& x) {
        return averaged_step(point, start, {-1e-5, 0.2e-5, 0}, x).mean;
      };
      const MeanResponse at = mean(place);
      test_support::expect_derivative(
          [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return mean(x).force; }, place,
          -(at.tangent + at.coupling.force * at.coupling.by.transpose()), 1e-9, 1e-6);
    }
  }
}

// Over a step the energy of springs and the dissipation of sliding and dashpots add up to the work.
TEST(Dashpots, MeanForcesLoseWhatTheyDamp) {
  std::mt19937_64 random(11);
  const auto any = [&](double most) { return most * (0x1p-52 * static_cast<double>(random() >> 11U) - 1.0); };
  int locked = 0, slid = 0, let_go = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const double g0 = any(1e-5), g1 = any(1e-5);
    const Eigen::Vector2d trial_slip(any(1e-5), any(1e-5)), shift(any(3e-5), any(3e-5));
    PointLaw plain = damped(0.0, {0, 0}, std::abs(any(3.0)));
    Dashpots dashpots = plain.dashpots;
    dashpots.normal = std::abs(any(1e9));
    plain.dashpots = {};
    const PointResponse start = point_response(plain, g0, trial_slip);
    const Eigen::Vector2d e0 = elastic_slip(plain, start, trial_slip);
    PointLaw point = plain;
    point.dashpots = {dashpots.normal, dashpots.shear, g0, e0};
    const auto [end, mean] =
        averaged_step(point, start, {g0, e0.x(), e0.y()}, {g1, e0.x() + shift.x(), e0.y() + shift.y()});
    const double work = mean.force[0] * (g1 - g0) + mean.force.tail<2>().dot(shift);
    const double scale = start.energy() + end.energy() + std::abs(work) + end.damped;
    const double lost = start.energy() - end.energy() - work - end.damped;
    EXPECT_GE(mean.force[0], 0.0) << trial;
    EXPECT_GE(end.damped, 0.0) << trial;
    EXPECT_GE(lost, -1e-12 * scale) << trial;
    let_go += mean.force[0] == 0.0 && g1 < 0.0 ? 1 : 0;
    if (end.state == ContactState::locked) {
      EXPECT_LE(lost, 1e-12 * scale) << trial;
      ++locked;
    } else if (end.state == ContactState::sliding) {
      const Eigen::Vector2d plastic = e0 + shift - elastic_slip(point, end, e0 + shift);
      EXPECT_NEAR(lost, -mean.force.tail<2>().dot(plastic), 1e-12 * scale) << trial;
      ++slid;
    }
  }
  EXPECT_GT(locked, 100);
  EXPECT_GT(slid, 1000);
  EXPECT_GT(let_go, 100);
}

}  // namespace
}  // namespace ashlar::dashpots_test
