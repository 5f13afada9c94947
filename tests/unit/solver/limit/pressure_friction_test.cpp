#include "solver/limit/pressure_friction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::pressure_friction_test {
namespace {

using test_support::g;
using test_support::joint;
using test_support::rock;
using test_support::tangent_of;
using Scene = test_support::LimitScene;

constexpr double worn = 28.0, jrc = 8.0, jcs = 5e7;

/// Two blocks of 2 x 1 m, 0.1 and 0.4 m high, on one another and on the ground.
Scene stack() {
  Scene scene;
  scene.law = joint(tangent_of(worn));
  scene.law.residual = ResidualStrength{scene.law.friction, 0.0, 0.0};
  scene.law.roughness = {jrc, jcs, scene.law.friction};
  scene.add("lower", Polyhedron(make_box({-1, -0.5, 0}, {1, 0.5, 0.4})));
  scene.add("upper", Polyhedron(make_box({-1, -0.5, 0.4}, {1, 0.5, 0.5})));
  scene.add_fixed(Polyhedron(make_box({-2, -2, -1}, {2, 2, 0})));
  return scene;
}

/// tan(phi) of Barton and Choubey, whose angle is at most 70 degrees.
double friction_at(double pressure) {
  return tangent_of(std::min(70.0, worn + jrc * std::log10(jcs / pressure)));
}

TEST(PressureFriction, EachJointHasThatOfItsPressure) {
  const RigidModel model = stack().build().rigid_model(0.0);
  const PairFriction friction = pressure_friction(model);
  ASSERT_EQ(friction.size(), 2U);
  EXPECT_NEAR(friction.at({0, 1}) / friction_at(rock.density * g * 0.1), 1.0, 1e-4);
  EXPECT_NEAR(friction.at({0, 2}) / friction_at(rock.density * g * 0.5), 1.0, 1e-4);
  EXPECT_FALSE(loses_strength(model));
}

TEST(PressureFriction, AnInclinedBlockHasThatOfThePressureAcrossItsJoint) {
  for (const double degrees : {30.0, 45.0}) {
    Scene scene = stack();
    const double turn = degrees * std::numbers::pi / 180.0;
    scene.gravity = {g * std::sin(turn), 0.0, -g * std::cos(turn)};
    const PairFriction friction = pressure_friction(scene.build().rigid_model(0.0));
    EXPECT_NEAR(friction.at({0, 1}) / friction_at(rock.density * g * 0.1 * std::cos(turn)), 1.0, 0.01);
  }
}

TEST(PressureFriction, EccentricForcesHaveLessFriction) {
  // A block 2 m long and 0.5 m high that leans by 45 degrees: its weight acts 0.25 m from the middle. The pressure is linear, from 1.75
  // to 0.25 of its mean; and 1.2 m high, 0.6 m from the middle: from 10/3 of the mean to 0 over 1.2 m.
  const auto friction_of = [](double height) {
    Scene scene;
    scene.law = joint(tangent_of(worn));
    scene.law.residual = ResidualStrength{scene.law.friction, 0.0, 0.0};
    scene.law.roughness = {jrc, jcs, scene.law.friction};
    scene.add("block", Polyhedron(make_box({-1, -0.5, 0}, {1, 0.5, height})));
    scene.add_fixed(Polyhedron(make_box({-2, -2, -1}, {2, 2, 0})));
    scene.gravity = {std::sqrt(0.5) * g, 0.0, -std::sqrt(0.5) * g};
    return pressure_friction(scene.build().rigid_model(0.0)).at({0, 1});
  };
  const auto mean_friction = [](double height, double least, double most, double length) {
    const double pressure = std::sqrt(0.5) * rock.density * g * height;
    double sum = 0.0;
    for (int k = 0; k < 1000; ++k) {
      const double share = least + (most - least) * (k + 0.5) / 1000.0;
      sum += share * friction_at(share * pressure) * 0.5 * length / 1000.0;
    }
    return sum;
  };
  EXPECT_NEAR(friction_of(0.5) / mean_friction(0.5, 0.25, 1.75, 2.0), 1.0, 2e-3);
  EXPECT_NEAR(friction_of(1.2) / mean_friction(1.2, 0.0, 10.0 / 3.0, 1.2), 1.0, 5e-3);
}

TEST(PressureFriction, AJointThatWearsKeepsTheFrictionOfTheWornJoint) {
  Scene scene = stack();
  scene.law.roughness.peak_slip = 1e-3;
  RigidModel model = scene.build().rigid_model(0.0);
  EXPECT_TRUE(loses_strength(model));
  keep_residual_strength(model);
  EXPECT_FALSE(has_pressure_friction(model));
  for (const RigidPoint& point : model.points) EXPECT_NEAR(point.law.friction, tangent_of(worn), 1e-15);
}

TEST(PressureFriction, LoadsThatPressHaveLessFriction) {
  // 20 times the weight of the upper block on its top.
  Scene scene = stack();
  scene.blocks[1].loads.push_back({Vector3(0, 0, 0.5), false, {0, 0, -20.0 * rock.density * g * 0.2}, {}});
  RigidModel model = scene.build().rigid_model(0.0, {false, true, false});
  EXPECT_NEAR(pressure_friction(model).at({0, 1}) / friction_at(21.0 * rock.density * g * 0.1), 1.0, 1e-3);
  EXPECT_GT(set_pressure_friction(model, LimitFactors{1.0, 0.0}), 0.01);
  EXPECT_NEAR(pressure_friction(model).at({0, 1}) / friction_at(rock.density * g * 0.1), 1.0, 1e-3);
}

}  // namespace
}  // namespace ashlar::pressure_friction_test
