// Motion under Coulomb's law of bodies whose accelerations and limits are known by hand.
#include "solver/limit/released_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::released_motion_test {
namespace {

using test_support::g;
using test_support::joint;
using test_support::on_slope;
using test_support::tangent_of;

/// A model and its programme.
struct Sample {
  explicit Sample(const test_support::LimitScene& scene)
      : model(scene.build().rigid_model(1.0, {})), program(program_of(model, 1)) {
    for (const RigidPoint& point : model.points) dilation.push_back(point.law.dilation);
  }
  [[nodiscard]] ReleasedMotion from_rest() const {
    return motion_from_rest(program, dilation, model.steady, {});
  }
  /// Acceleration of the first body, m/s^2.
  [[nodiscard]] Vector3 acceleration(const ReleasedMotion& motion) const {
    return motion_of(model.bodies[0], model.units.acceleration * motion.velocity[0]).translation;
  }

  RigidModel model;
  ConeProgram program;
  std::vector<double> dilation;
};

TEST(ReleasedMotion, ABlockSlidesWithoutLeavingItsPlane) {
  const double slope = std::numbers::pi / 6.0;
  const ReleasedMotion motion = Sample(on_slope(30.0, joint(0.4), 0)).from_rest();
  ASSERT_EQ(motion.outcome, LimitOutcome::moves);
  const Vector3 found = Sample(on_slope(30.0, joint(0.4), 0)).acceleration(motion);
  EXPECT_NEAR(found.norm(), g * (std::sin(slope) - 0.4 * std::cos(slope)), 1e-6);
  EXPECT_NEAR(found.normalized().dot(Vector3(-std::sin(slope), 0.0, std::cos(slope))), 0.0, 1e-6);
}

TEST(ReleasedMotion, ADilatingJointOpensByItsAngle) {
  // a_n = tan(psi) a_t and N = m (g cos + a_n): a_t = g (sin - mu cos)/(1 + mu tan(psi)).
  const double slope = std::numbers::pi / 6.0, opening = tangent_of(10.0);
  const Sample sample(on_slope(30.0, joint(0.4, 0.0, opening), 0));
  const ReleasedMotion motion = sample.from_rest();
  ASSERT_EQ(motion.outcome, LimitOutcome::moves);
  const double along = g * (std::sin(slope) - 0.4 * std::cos(slope)) / (1.0 + 0.4 * opening);
  EXPECT_NEAR(sample.acceleration(motion).norm(), along * std::hypot(1.0, opening), 1e-6);
}

TEST(ReleasedMotion, ABlockBelowItsFrictionAngleRests) {
  const Sample sample(on_slope(20.0, joint(0.4), 0));
  const ReleasedMotion motion = sample.from_rest();
  EXPECT_EQ(motion.outcome, LimitOutcome::stands);
  EXPECT_LT(largest_motion(motion.velocity, sample.model.steady), 1e-4);
}

/// A body of two coordinates between two planes that spread downwards, each at an angle b to the vertical: it may fall,
/// or be wedged if friction is more than tan(b).
struct Keystone {
  static constexpr double b = 0.3;
  explicit Keystone(double friction) : program({2}, {{{0, -1}, 0, 2}}, points(friction), 1) {
    load = {BodyVelocity::Zero()};
    load[0][1] = -1.0;
  }
  static std::vector<ConePoint> points(double friction) {
    std::vector<ConePoint> points(2);
    for (const int side : {0, 1}) {
      ConePoint& point = points[static_cast<std::size_t>(side)];
      const double sign = side == 0 ? 1.0 : -1.0;
      point.first.row(0).head<2>() << sign * std::cos(b), -std::sin(b);
      point.first.row(1).head<2>() << sign * std::sin(b), std::cos(b);
      point.strength.friction = friction;
    }
    return points;
  }

  ConeProgram program;
  std::vector<BodyVelocity> load;
  std::vector<double> dilation{0.0, 0.0};
};

TEST(ReleasedMotion, AKeystoneFallsFromNoForcesAndStandsFromThoseThatWedgeIt) {
  Keystone keystone(0.8);
  const ReleasedMotion falls = motion_from_rest(keystone.program, keystone.dilation, keystone.load, {});
  ASSERT_EQ(falls.outcome, LimitOutcome::moves);
  EXPECT_NEAR(falls.velocity[0][1], -1.0, 1e-9);
  // 2 (t cos(b) - N sin(b)) = 1, t half of its bound.
  const double normal = 0.5 / (0.6 * std::cos(Keystone::b) - std::sin(Keystone::b));
  const std::vector<Eigen::Vector3d> wedged(2, {normal, 0.6 * normal, 0.0});
  EXPECT_EQ(motion_from_rest(keystone.program, keystone.dilation, keystone.load, wedged).outcome,
            LimitOutcome::stands);
}

TEST(ReleasedMotion, SlipOfAKeystoneGrows) {
  // The forces of least normal force are at the limit of friction. With s = mu cos(b) |v| and the power of the load
  // 1 |v'| = 2 s N, slip grows by mu cos(b)/(mu cos(b) - sin(b)) > 1: it may fall under any wedging.
  Keystone keystone(0.8);
  std::vector<BodyVelocity> start = {BodyVelocity::Zero()};
  start[0][1] = -1.0;
  const ReleasedMotion slip = slow_slip(keystone.program, keystone.dilation, keystone.load, start, 1e-4);
  ASSERT_EQ(slip.outcome, LimitOutcome::moves);
  EXPECT_LT(slip.velocity[0][1], 0.0);
  const ReleasedMotion motion =
      motion_of_slip(keystone.program, keystone.dilation, keystone.load, slip.velocity);
  ASSERT_EQ(motion.outcome, LimitOutcome::moves);
  EXPECT_NEAR(motion.velocity[0][1], -1.0, 1e-9);
}

TEST(ReleasedMotion, SlipOfABlockBelowItsFrictionAngleEnds) {
  Sample sample(on_slope(20.0, joint(0.4), 0));
  const std::vector<BodyVelocity> start = {sample.model.steady[0]};
  const ReleasedMotion slip = slow_slip(sample.program, sample.dilation, sample.model.steady, start, 1e-4);
  EXPECT_EQ(slip.outcome, LimitOutcome::stands);
  EXPECT_EQ(
      slow_slip(sample.program, sample.dilation, sample.model.steady, {BodyVelocity::Zero()}, 1e-4).outcome,
      LimitOutcome::stands);
}

TEST(ReleasedMotion, MotionIsMeasuredByTheLoads) {
  std::vector<BodyVelocity> velocity(2, BodyVelocity::Zero()), load = velocity;
  EXPECT_EQ(largest_motion(velocity, load), 0.0);
  load[0][0] = 4.0;
  velocity[0][1] = 1.0;
  EXPECT_EQ(largest_motion(velocity, load), 0.25);
  velocity[1][2] = 1.0;  // without a load of its own
  EXPECT_EQ(largest_motion(velocity, load), 250.0);
}

}  // namespace
}  // namespace ashlar::released_motion_test
