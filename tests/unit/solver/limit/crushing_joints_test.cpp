// Joints that crush, of blocks whose limits are known by hand.
#include "solver/limit/crushing_joints.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "solver/limit/least_strength.hpp"
#include "solver/limit/limit_analysis.hpp"
#include "solver/paths/thrust.hpp"
#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::crushing_joints_test {
namespace {

using test_support::g;
using test_support::joint;
using test_support::rock;
using test_support::tangent_of;
using Scene = test_support::LimitScene;

/// Accelerations up to 1e-4 of the loads count as rest, which is the error of a factor.
constexpr double stillness = 5e-4;

void expect_bracket(const LimitBracket& bracket, double factor, double tolerance, const std::string& what,
                    double rest = stillness) {
  ASSERT_TRUE(bracket.lower && bracket.upper) << what;
  EXPECT_TRUE(bracket.resolved) << what;
  EXPECT_LE(*bracket.lower, factor * (1.0 + rest)) << what;
  EXPECT_GE(*bracket.upper, factor * (1.0 - rest)) << what;
  EXPECT_LE(*bracket.upper, *bracket.lower * (1.0 + tolerance) * (1.0 + 1e-12)) << what;
}

void expect_factor(const LimitAnswer& answer, double factor, const std::string& what,
                   double rest = stillness) {
  expect_bracket(answer.associated, factor, 1e-3, what + ", associated", rest);
  expect_bracket(answer.released, factor, 1e-3, what + ", released", rest);
}

JointLaw crushing(double friction, double strength, double cohesion = 0.0) {
  JointLaw law = joint(friction, cohesion);
  law.compressive_strength = strength;
  return law;
}

void add_load(Scene& scene, int block, const Vector3& place, const Vector3& force) {
  scene.blocks[static_cast<std::size_t>(block)].loads.push_back({place, false, force, {}});
}

/// A block b x t x h on the ground.
Scene pier(double b, double t, double h, const JointLaw& law) {
  Scene scene;
  scene.law = law;
  scene.add("pier", Polyhedron(make_box({0, 0, 0}, {b, t, h})));
  scene.add_fixed(Polyhedron(make_box({-1, -1, -1}, {b + 1, t + 1, 0})));
  return scene;
}

/// Factor of the loads of the first block.
LimitAnswer load_factor(const Scene& scene, double tolerance = 1e-3) {
  return scene.analysis({true, false}).load_factor({1e-3, 1e3, tolerance}, [] { return true; });
}

/// @param weight of the pier. The load of gravity alone is steady.
double weight_of(double b, double t, double h) {
  return rock.density * g * b * t * h;
}

TEST(CrushingJoints, APushedBlockCrushesItsToe) {
  // About the middle of its stress block of width w = W/(f t): V h = W (b - w)/2.
  for (const auto& [b, t, h] : {std::array{0.4, 1.0, 2.0}, {1.0, 0.2, 1.5}}) {
    const double weight = weight_of(b, t, h);
    for (const double share : {0.02, 0.1, 0.5, 0.9}) {
      const double strength = weight / (share * b * t);
      Scene scene = pier(b, t, h, crushing(0.7, strength));
      add_load(scene, 0, {0.5 * b, 0.5 * t, h}, {weight, 0, 0});
      // Rest is a force of 1e-4 W.
      const double factor = 0.5 * (b - share * b) / h;
      expect_factor(load_factor(scene), factor, std::to_string(share), std::max(stillness, 1e-4 / factor));
    }
  }
}

TEST(CrushingJoints, APushedBlockUnderALoadCrushesItsToe) {
  // N and the weights of a pier and its cap act on its middle: V h = N' (b/2 - N'/(2 f t)), N' = N + W.
  const double b = 0.8, t = 0.3, h = 1.6, top = 0.2;
  for (const double n : {0.0, 2e4, 1e5}) {
    const double all = n + weight_of(b, t, h + top);
    for (const double strength : {all / (0.05 * b * t), all / (0.4 * b * t)}) {
      Scene scene = pier(b, t, h, crushing(0.7, strength));
      const int cap = scene.add("cap", Polyhedron(make_box({0, 0, h}, {b, t, h + top})));
      add_load(scene, 0, {0.0, 0.5 * t, h}, {1e3, 0, 0});
      add_load(scene, cap, {0.5 * b, 0.5 * t, h + top}, {0, 0, -n});
      const LimitAnswer answer =
          scene.analysis({true, false, false}).load_factor({1e-3, 1e3, 1e-3}, [] { return true; });
      expect_factor(answer, all * (0.5 * b - 0.5 * all / (strength * t)) / (1e3 * h), std::to_string(n));
    }
  }
}

TEST(CrushingJoints, ACentricPierCrushesAtItsArea) {
  // P + W = f A, in any position and size; its factor of safety is f A/W.
  const double weight = weight_of(0.6, 0.9, 1.2), strength = 5.0 * weight / (0.6 * 0.9);
  Scene scene = pier(0.6, 0.9, 1.2, crushing(0.5, strength));
  expect_factor(scene.safety(), 5.0, "safety");
  Scene scaled = scene.scaled(10.0);
  scaled.law.compressive_strength *= 10.0;
  expect_factor(scaled.safety(), 5.0, "scaled");
  add_load(scene, 0, {0.3, 0.45, 1.2}, {0, 0, -weight});
  expect_factor(load_factor(scene), 4.0, "load");
  expect_factor(load_factor(scene.turned(Eigen::AngleAxisd(0.8, Vector3(1, 2, 3).normalized()))), 4.0,
                "turned");
}

TEST(CrushingJoints, ACornerOfASquarePierCrushesAsATriangle) {
  // Without weight. The most force at (x, x) has pressure f on one side of a line (a linear programme with two moments),
  // across the diagonal: a triangle of legs 3 x while that is within the side a, x <= a/3: f (3 x)^2/2. Beyond, the square
  // without a triangle of legs d in its far corner, whose centroid is at x.
  const double a = 0.9, strength = 4e5;
  for (const double x : {0.18, 0.2, 0.3, 0.36, 0.42}) {
    double area = 4.5 * x * x;
    if (x > a / 3.0) {
      double low = 0.0, high = a;
      for (int n = 0; n < 100; ++n) {
        const double d = 0.5 * (low + high), left = a * a - 0.5 * d * d;
        const double moment = 0.5 * a * a * a - 0.5 * d * d * (a - d / 3.0);
        (moment > x * left ? low : high) = d;
        area = left;
      }
    }
    Scene scene = pier(a, a, 0.5, crushing(0.5, strength));
    scene.gravity.setZero();
    add_load(scene, 0, {x, x, 0.5}, {0, 0, -1e4});
    expect_factor(load_factor(scene), strength * area / 1e4, std::to_string(x));
    expect_factor(load_factor(scene.turned(Eigen::AngleAxisd(2.5, Vector3(-1, 0.2, 0.7).normalized()))),
                  strength * area / 1e4, std::to_string(x) + " turned");
  }
}

TEST(CrushingJoints, TensileStrengthActsBesideTheStressBlock) {
  // W + T (b - w) t = f w t, and about the middle V h = (f + T) t w (b - w)/2; cohesion holds the shear force.
  const double b = 0.5, t = 0.4, h = 3.0, weight = weight_of(b, t, h);
  const double tension = 0.5 * weight / (b * t), strength = 6.0 * tension;
  Scene scene = pier(b, t, h, crushing(0.6, strength, 20.0 * tension));
  scene.law.tensile_strength = tension;
  add_load(scene, 0, {0.0, 0.5 * t, h}, {weight, 0, 0});
  const double w = (weight + tension * b * t) / ((strength + tension) * t);
  expect_factor(load_factor(scene), 0.5 * (strength + tension) * t * w * (b - w) / (weight * h), "tension");
}

/// Two blocks L x t x d between abutments, which they press apart, with a load P on the middle of each.
Scene flat_arch(double length, double depth, double thickness, double load, const JointLaw& law) {
  Scene scene;
  scene.law = law;
  for (const double side : {0.0, 1.0}) {
    const double from = (side - 1.0) * length;
    const int block = scene.add(side > 0.0 ? "right" : "left",
                                Polyhedron(make_box({from, 0, 0}, {from + length, thickness, depth})));
    add_load(scene, block, {from + 0.5 * length, 0.5 * thickness, depth}, {0, 0, -load});
  }
  scene.add_fixed(Polyhedron(make_box({-length - 1, -1, -1}, {-length, thickness + 1, depth + 1})));
  scene.add_fixed(Polyhedron(make_box({length, -1, -1}, {length + 1, thickness + 1, depth + 1})));
  return scene;
}

TEST(CrushingJoints, AFlatArchCrushesAtItsLeverArm) {
  // Thrust H in stress blocks w = H/(f t) at the top of the middle and the bottom of the abutments: Q L/2 = H (d - w),
  // at most f t d^2/4, of the load Q of each block.
  const double length = 1.5, depth = 0.5, thickness = 0.4, weight = weight_of(length, thickness, depth);
  const double strength = 20.0 * weight * length / (thickness * depth * depth);
  const Scene scene = flat_arch(length, depth, thickness, weight, crushing(3.0, strength));
  const LimitAnswer answer =
      scene.analysis({true, true, false, false}).load_factor({0.01, 100.0, 1e-3}, [] { return true; });
  const double most = 0.5 * strength * thickness * depth * depth / length;
  expect_bracket(answer.associated, most / weight - 1.0, 1e-3, "arch");
}

TEST(CrushingJoints, ThrustHasTheStressBlocksOfItsLine) {
  // H (d - H/(f t)) = W L/2 has two solutions: the line of thrust rises to the middle.
  const double length = 1.5, depth = 0.5, thickness = 0.4, weight = weight_of(length, thickness, depth);
  for (const double share : {0.2, 0.8}) {
    const double strength = 2.0 * weight * length / (share * thickness * depth * depth);
    const Scene scene = flat_arch(length, depth, thickness, 0.0, crushing(3.0, strength));
    for (const auto& placed : {scene, scene.turned(Eigen::AngleAxisd(0.8, Vector3(1, 2, 3).normalized()))}) {
      RigidModel model = placed.build().rigid_model(1.0);
      divide_for_thrust(model, placed.gravity, 1);
      const std::vector<ThrustRange> ranges = thrust_ranges(model, placed.gravity, 1);
      ASSERT_EQ(ranges.size(), 2U);
      for (const ThrustRange& range : ranges) {
        ASSERT_TRUE(range.least && range.most);
        const double all = 0.5 * strength * thickness * depth, root = std::sqrt(1.0 - share);
        EXPECT_NEAR(range.least->thrust, all * (1.0 - root), 1e-3 * all * (1.0 - root)) << share;
        EXPECT_NEAR(range.most->thrust, all * (1.0 + root), 1e-3 * all * (1.0 + root)) << share;
        EXPECT_LT(range.least->gap, 1e-3);
        EXPECT_LT(range.most->gap, 1e-3);
      }
    }
  }
}

TEST(CrushingJoints, TheStrengthABlockNeedsIsThatOfItsToe) {
  // f = W/(w t), w = b - 2 V h/W.
  const double b = 1.0, t = 0.2, h = 1.5, weight = weight_of(b, t, h);
  Scene scene = pier(b, t, h, joint(0.7));
  add_load(scene, 0, {0.0, 0.5 * t, h}, {weight, 0, 0});
  LimitAnalysis analysis = scene.analysis({true, false});
  for (const double share : {0.3, 0.9, 0.99}) {
    const double factor = share * 0.5 * b / h, strength = weight / ((1.0 - share) * b * t);
    const auto least = least_strength(analysis.model(), analysis.reduced(), {1.0, factor}, 1);
    ASSERT_TRUE(least) << share;
    // Rest is 1e-5 of the loads, which shifts their resultant by 1e-5 of the radius of inertia and the lever arms: 2e-5 m
    // of the half of w.
    EXPECT_GE(least->value, strength * (1.0 - 2e-5 / (0.5 * (1.0 - share) * b))) << share;
    EXPECT_LE(least->value, 1.03 * strength) << share;
    EXPECT_EQ(key_of(least->joint), (PairKey{0, 1}));
  }
  // Above the factor of toppling no strength is enough.
  EXPECT_FALSE(least_strength(analysis.model(), analysis.reduced(), {1.0, 0.51 * b / h}, 1));
  // The pressure of a divided strength is that of the strength.
  const auto divided = least_strength(analysis.model(), analysis.reduced(), {2.0, 0.0}, 1);
  ASSERT_TRUE(divided);
  EXPECT_NEAR(divided->value, 2.0 * weight / (b * t), 0.03 * weight / (b * t));
}

TEST(CrushingJoints, TheLeastStrengthBesideCohesionIsEnough) {
  const double b = 0.5, t = 0.4, h = 3.0, weight = weight_of(b, t, h), tension = 0.5 * weight / (b * t);
  Scene scene = pier(b, t, h, joint(0.6, 20.0 * tension));
  scene.law.tensile_strength = tension;
  add_load(scene, 0, {0.0, 0.5 * t, h}, {weight, 0, 0});
  // As above: the strength 6 T has this factor.
  const double w = (weight + tension * b * t) / (7.0 * tension * t);
  const double factor = 3.5 * tension * t * w * (b - w) / (weight * h);
  LimitAnalysis analysis = scene.analysis({true, false});
  const auto least = least_strength(analysis.model(), analysis.reduced(), {1.0, factor}, 1);
  ASSERT_TRUE(least);
  EXPECT_GE(least->value, 6.0 * tension * (1.0 - 1e-4));
  EXPECT_LE(least->value, 6.0 * tension * 1.08);
}

}  // namespace
}  // namespace ashlar::crushing_joints_test
