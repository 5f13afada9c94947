// Forces of a contact point that are means over a step.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <tuple>
#include <utility>

#include "mechanics/contact/laws/joint_law.hpp"
#include "support/check_derivatives.hpp"
#include "unit/mechanics/contact/laws/sample_joint.hpp"

namespace ashlar::mean_force_test {
namespace {

using test_support::law;
using test_support::left_out;

TEST(JointLaw, AMeanForceHasNoKinkWhereGapsAreRounding) {
  JointLaw rounded = law;
  rounded.rounding = 1e-14;
  rounded.tensile_strength = 0.0;
  for (const bool intact : {false, true}) {
    const PointLaw point = point_law(rounded, 0.1, intact);
    const auto mean = [&](double from, double to) {
      const PointResponse start = point_response(point, from, {0, 0});
      return averaged_step(point, start, {from, 0, 0}, {to, 1e-7, 0}).mean;
    };
    // Opens from touch, closes to it, presses from it.
    for (const auto& [from, to] : {std::array{0.0, 1e-6}, std::array{1e-6, 0.0}, std::array{0.0, -1e-6}}) {
      const MeanResponse exact = mean(from, to);
      for (const double error : {-0.9e-14, 0.9e-14}) {
        const MeanResponse other = mean(from == 0.0 ? error : from, to == 0.0 ? error : to);
        EXPECT_LT((other.force - exact.force).norm(), 1e-4) << from << " " << to;
        EXPECT_TRUE(std::isfinite(other.limit));
        EXPECT_NEAR(other.limit, exact.limit, 1e-3);
      }
    }
    // A point closed by rounding is closed for no share of a step to an open position.
    EXPECT_EQ(mean(0.9e-14, 1.1e-14).limit, 0.0);
    EXPECT_EQ(mean(1.1e-14, 0.9e-14).limit, 0.0);
  }
}

TEST(JointLaw, MeanForceDoesExactlyTheWorkOfTheSpring) {
  const PointLaw point = point_law(law, 0.1, false);
  for (const auto& [g0, g1] :
       {std::pair{1e-4, -3e-5}, {-3e-5, 1e-4}, {-2e-5, -7e-5}, {1e-4, 2e-4}, {0.0, -1e-5}}) {
    const PointResponse start = point_response(point, g0, {0, 0});
    const auto step_to = [&, from = g0](double to) {
      return averaged_step(point, start, {from, 0, 0}, {to, 0, 0});
    };
    const PointResponse end = step_to(g1).end;
    const MeanResponse mean = step_to(g1).mean;
    EXPECT_NEAR(mean.force[0] * (g1 - g0), start.energy() - end.energy(),
                1e-12 * (start.energy() + end.energy()));
    test_support::expect_derivative(
        [&](const Eigen::VectorXd& x) { return Eigen::VectorXd::Constant(1, step_to(x[0]).mean.force[0]); },
        Eigen::VectorXd::Constant(1, g1), Eigen::MatrixXd::Constant(1, 1, -mean.tangent(0, 0)), 1e-9, 1e-5);
    EXPECT_GE(mean.tangent(0, 0), 0.0);
  }
}

// For any motion of a point in a step, locked, sliding, reversing, opening: the work of its mean force never exceeds
// the loss of its springs' energy, and equals it where the point stays locked.
TEST(JointLaw, MeanForcesGiveNoWorkOfTheirOwn) {
  std::mt19937_64 random(20261121);
  const auto any = [&](double most) { return most * (0x1p-52 * static_cast<double>(random() >> 11U) - 1.0); };
  int lossless = 0, slid = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    JointLaw joint = law;
    joint.friction = trial % 3 == 0 ? 0.0 : std::abs(any(2.0));
    joint.cohesion = trial % 4 == 0 ? std::abs(any(1e4)) : 0.0;
    const PointLaw point = point_law(joint, 0.1, true);
    PointLaw plain = point;
    plain.tension = 0.0;
    const double g0 = any(1e-5), g1 = any(1e-5);
    const Eigen::Vector2d trial_slip(any(1e-5), any(1e-5)), shift(any(3e-5), any(3e-5));
    const PointResponse start = point_response(plain, g0, trial_slip);
    const Eigen::Vector2d e0 = elastic_slip(plain, start, trial_slip);
    const Eigen::Vector3d start_place(g0, e0.x(), e0.y());
    const Eigen::Vector3d end_place(g1, e0.x() + shift.x(), e0.y() + shift.y());
    const auto [end, mean] = averaged_step(plain, start, start_place, end_place);
    const double work = mean.force[0] * (g1 - g0) + mean.force.tail<2>().dot(shift);
    const double lost = start.energy() - end.energy() - work;
    const double scale = start.energy() + end.energy() + std::abs(work);
    EXPECT_GE(lost, -1e-12 * scale) << trial;
    const double limit = std::max(mean.force[0], 0.0) * plain.friction + plain.cohesion;
    EXPECT_LE(mean.force.tail<2>().norm(), limit * (1.0 + 1e-12)) << trial;
    if (end.state == ContactState::locked) {
      EXPECT_LE(std::abs(lost), 1e-12 * scale) << trial;
      ++lossless;
    }
    slid += end.state == ContactState::sliding ? 1 : 0;
  }
  EXPECT_GT(lossless, 100);
  EXPECT_GT(slid, 1000);
}

TEST(JointLaw, MeanFrictionIsThatOfTheMeanNormalForce) {
  // From no force to 2 N and back, as stiff contacts alternate: N tan(phi) over both steps, sliding on and
  // on.
  JointLaw joint = law;
  joint.friction = 0.5;
  joint.cohesion = joint.tensile_strength = 0.0;
  const PointLaw point = point_law(joint, 0.1, false);
  const double depth = 1e-5, normal = 0.5 * point.normal_stiffness * depth;
  const Eigen::Vector2d shift(3e-4, 4e-4);
  const PointResponse free = point_response(point, 0.0, Eigen::Vector2d::Zero());
  const AveragedStep in = averaged_step(point, free, {0, 0, 0}, {-depth, shift.x(), shift.y()});
  EXPECT_NEAR(in.mean.force[0], normal, 1e-9 * normal);
  EXPECT_NEAR((in.mean.force.tail<2>() + 0.5 * normal * shift.normalized()).norm(), 0.0, 1e-9 * normal);
  const PointResponse pressed = point_response(point, -depth, elastic_slip(point, in.end, shift));
  const Eigen::Vector2d slip = elastic_slip(point, in.end, shift);
  const AveragedStep out = averaged_step(point, pressed, {-depth, slip.x(), slip.y()},
                                         {0.0, slip.x() + shift.x(), slip.y() + shift.y()});
  EXPECT_NEAR(out.mean.force[0], normal, 1e-9 * normal);
  EXPECT_NEAR((out.mean.force.tail<2>() + 0.5 * normal * shift.normalized()).norm(), 0.0, 1e-9 * normal);
}

TEST(JointLaw, MeanCohesionIsThatOfTheTimeInContact) {
  JointLaw joint = law;
  joint.friction = joint.tensile_strength = 0.0;
  const PointLaw point = point_law(joint, 0.1, true);
  const Eigen::Vector2d shift(3e-2, 4e-2);  // far beyond the limit
  const auto mean = [&](double g0, double g1) {
    return averaged_step(point, point_response(point, g0, {0, 0}), {g0, 0, 0}, {g1, shift.x(), shift.y()})
        .mean;
  };
  // From 1 deep to 3 above: a quarter of the time. From 3 above to 1 deep likewise.
  for (const auto& [g0, g1, share] :
       {std::tuple{-1e-5, 3e-5, 0.25}, {3e-5, -1e-5, 0.25}, {-1e-5, -3e-5, 1.0}, {1e-5, 3e-5, 0.0}}) {
    EXPECT_NEAR((mean(g0, g1).force.tail<2>() + share * point.cohesion * shift.normalized()).norm(), 0.0,
                1e-12 * point.cohesion);
    EXPECT_NEAR(mean(g0, g1).limit, share * point.cohesion, 1e-12 * point.cohesion);
  }
  // Blocks that are placed at the surface: the side of it that rounding puts them on does not matter.
  for (const double g1 : {-1e-5, 1e-5}) {
    EXPECT_NEAR((mean(1e-17, g1).force - mean(-1e-17, g1).force).norm(), 0.0, 1e-9 * point.cohesion);
  }
}

TEST(JointLaw, MeanCouplingIsWhatTheMeanTangentLeavesOut) {
  const PointLaw point = point_law(law, 0.1, false);
  // Locked with much shear under much pressure, then little pressure: cut, whether it slides on or not.
  const PointResponse start = point_response(point, -5e-5, {5e-5, 2e-5});
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(-1e-5, 9e-5, -7e-5), Eigen::Vector3d(-1e-5, 3e-6, 2e-6)}) {
    const auto mean = [&](const Eigen::Vector3d& x) {
      return averaged_step(point, start, {-5e-5, 5e-5, 2e-5}, x).mean;
    };
    Eigen::Matrix3d whole = mean(place).tangent;
    whole += left_out(mean(place).coupling);
    test_support::expect_derivative(
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return mean(x).force; }, place, -whole, 1e-9,
        1e-6);
  }
  // With cohesion, opening and closing.
  JointLaw cohesive = law;
  cohesive.tensile_strength = 0.0;
  const PointLaw intact = point_law(cohesive, 0.1, true);
  for (const auto& [g0, g1] : {std::pair{-2e-5, 3e-5}, {3e-5, -2e-5}}) {
    const Eigen::Vector3d from(g0, 0.0, 0.0), to(g1, 9e-3, -7e-3);
    const PointResponse at_start = point_response(intact, g0, {0, 0});
    const auto mean = [&](const Eigen::Vector3d& x) { return averaged_step(intact, at_start, from, x).mean; };
    Eigen::Matrix3d whole = mean(to).tangent;
    whole += left_out(mean(to).coupling);
    test_support::expect_derivative(
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return mean(x).force; }, to, -whole, 1e-9, 1e-6);
  }
}

TEST(JointLaw, APointThatJustTouchesOverAStepRubsWhereItIsPressed) {
  JointLaw dry = law;
  dry.cohesion = dry.tensile_strength = 0.0;
  const PointLaw point = point_law(dry, 0.1, false);
  const PointResponse start = point_response(point, 0.0, {0, 0});
  const auto mean = [&](double gap) {
    return averaged_step(point, start, Eigen::Vector3d::Zero(), {gap, 3e-6, 4e-6}).mean;
  };
  const MeanResponse touching = mean(0.0);
  EXPECT_TRUE(touching.force.isZero(0.0));
  // Pressed by d, the mean normal force is kn d / 2, and friction tan(phi) of that against the slip.
  const double normal = 0.5 * 2e9 * 0.1 * 1e-9;
  const Eigen::Vector3d pressed(normal, -0.5 * 0.6 * normal, -0.5 * 0.8 * normal);
  EXPECT_LT((mean(-1e-9).force - pressed).norm(), 1e-12 * normal);
  const Eigen::Matrix3d whole = touching.tangent + left_out(touching.coupling);
  EXPECT_LT((whole.col(0) * 1e-9 - pressed).norm(), 1e-12 * normal);
}

}  // namespace
}  // namespace ashlar::mean_force_test
