// Thrust of structures between supports, by hand.
#include "solver/paths/thrust.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::thrust_test {
namespace {

using test_support::g;
using test_support::joint;
using test_support::rock;
using test_support::tangent_of;

Polyhedron prism(const std::vector<std::array<double, 2>>& outline) {
  std::vector<Vector3> points;
  for (const auto& [x, z] : outline)
    for (const double y : {0.0, 1.0}) points.emplace_back(x, y, z);
  return Polyhedron(make_convex_hull(points));
}

/// A stone whose faces lean by an angle from the vertical, wider at its top, between two fixed ones.
test_support::LimitScene keystone(double angle, double friction_angle) {
  const double lean = tangent_of(angle);
  test_support::LimitScene scene;
  scene.law = joint(tangent_of(friction_angle));
  scene.add("stone", prism({{-0.5, 0}, {0.5, 0}, {0.5 + lean, 1}, {-0.5 - lean, 1}}));
  scene.add_fixed(prism({{-0.5, 0}, {-0.5 - lean, 1}, {-3, 1}, {-3, 0}}));
  scene.add_fixed(prism({{0.5, 0}, {0.5 + lean, 1}, {3, 1}, {3, 0}}));
  return scene;
}

TEST(Thrust, OfAKeystoneLiesBetweenTheCotangents) {
  // W/2 cot(b + phi) to W/2 cot(b - phi): friction up or down both faces.
  for (const auto& [angle, phi] : {std::pair{30.0, 10.0}, {40.0, 25.0}, {20.0, 5.0}}) {
    const test_support::LimitScene scene = keystone(angle, phi);
    const RigidModel model = scene.build().rigid_model(1.0, {});
    const double half = 0.5 * rock.density * g * (1.0 + tangent_of(angle));
    const std::vector<ThrustRange> ranges = thrust_ranges(model, scene.gravity, 1);
    ASSERT_EQ(ranges.size(), 2U);
    for (const ThrustRange& range : ranges) {
      ASSERT_TRUE(range.least && range.most);
      EXPECT_NEAR(range.least->thrust * tangent_of(angle + phi) / half, 1.0, 1e-5) << angle;
      EXPECT_NEAR(range.most->thrust * tangent_of(angle - phi) / half, 1.0, 1e-5) << angle;
      EXPECT_LT(range.most->gap, 1e-5);
    }
  }
}

TEST(Thrust, OfAKeystoneThatFrictionHoldsHasNoBound) {
  const test_support::LimitScene scene = keystone(20.0, 30.0);
  const std::vector<ThrustRange> ranges = thrust_ranges(scene.build().rigid_model(1.0, {}), scene.gravity, 1);
  ASSERT_EQ(ranges.size(), 2U);
  EXPECT_TRUE(ranges[0].least);
  EXPECT_FALSE(ranges[0].most);
}

TEST(Thrust, OfABoxOnTwoSupportsIsFrictionEitherWay) {
  test_support::LimitScene scene;
  scene.law = joint(0.4);
  scene.add("box", Polyhedron(make_box({-2, 0, 0}, {2, 1, 0.5})));
  scene.add_fixed(Polyhedron(make_box({-2, 0, -1}, {-1, 1, 0})));
  scene.add_fixed(Polyhedron(make_box({1, 0, -1}, {2, 1, 0})));
  const double friction = 0.4 * 0.5 * rock.density * g * 2.0;
  const std::vector<ThrustRange> ranges = thrust_ranges(scene.build().rigid_model(1.0, {}), scene.gravity, 1);
  ASSERT_EQ(ranges.size(), 2U);
  for (const ThrustRange& range : ranges) {
    ASSERT_TRUE(range.least && range.most);
    EXPECT_NEAR(range.most->thrust / friction, 1.0, 1e-5);
    EXPECT_NEAR(range.least->thrust / friction, -1.0, 1e-5);
  }
}

TEST(Thrust, ResultantsOfJointsBalanceTheWeight) {
  const test_support::LimitScene scene = keystone(30.0, 10.0);
  const RigidModel model = scene.build().rigid_model(1.0, {});
  const std::vector<ThrustRange> ranges = thrust_ranges(model, scene.gravity, 1);
  ASSERT_FALSE(ranges.empty());
  const std::vector<JointResultant> joints = joint_resultants(model, ranges[0].least->force);
  ASSERT_EQ(joints.size(), 2U);
  Vector3 sum = Vector3::Zero();
  for (const JointResultant& joint : joints) sum += joint.force;
  const double weight = rock.density * g * (1.0 + tangent_of(30.0));
  EXPECT_NEAR(std::abs(sum.z()) / weight, 1.0, 1e-5);
  EXPECT_NEAR(sum.x() / weight, 0.0, 1e-5);
}

}  // namespace
}  // namespace ashlar::thrust_test
