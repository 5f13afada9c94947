// Limits of joints with more tensile strength than cohesion over friction, by hand.
#include "solver/limit/pulled_joints.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::pulled_joints_test {
namespace {

using test_support::g;
using test_support::rock;
using test_support::tangent_of;
using test_support::tilted_box;
using Scene = test_support::LimitScene;

constexpr double strength = 1e5;  ///< T, Pa

JointLaw glue(double friction, double cohesion) {
  JointLaw law{1e10, 1e10, friction, cohesion, strength, true};
  law.residual = ResidualStrength{friction, cohesion, strength};
  return law;
}

void load_at(Scene& scene, int block, const Vector3& place, const Vector3& force) {
  scene.blocks[static_cast<std::size_t>(block)].loads.push_back({place, false, force, {}});
}

/// A box of some width below a roof at z = 0, with a load of 1 kN downwards.
Scene hung(double width, double cohesion) {
  Scene scene;
  scene.law = glue(0.7, cohesion);
  const int box = scene.add("box", Polyhedron(make_box({-0.5 * width, -0.5, -0.5}, {0.5 * width, 0.5, 0})));
  scene.add_fixed(Polyhedron(make_box({-4, -4, 0}, {4, 4, 1})));
  load_at(scene, box, {0, 0, -0.5}, {0, 0, -1e3});
  return scene;
}

/// Capacity of the loads of the first block, in their multiple.
LimitAnswer capacity(const Scene& scene) {
  std::vector<bool> multiplied(scene.blocks.size(), false);
  multiplied[0] = true;
  return scene.analysis(multiplied).load_factor({0.01, 1e4, 1e-3}, [] { return true; });
}

void expect_between(const LimitBracket& bracket, double factor, const std::string& what) {
  ASSERT_TRUE(bracket.lower && bracket.upper) << what;
  EXPECT_LE(*bracket.lower, factor * (1.0 + 5e-4)) << what;
  EXPECT_GE(*bracket.upper, factor * (1.0 - 5e-4)) << what;
  EXPECT_LE(*bracket.upper / *bracket.lower, 1.0011) << what;
}

void expect_both(const LimitAnswer& answer, double factor, const std::string& what) {
  expect_between(answer.associated, factor, what + ", associated");
  expect_between(answer.released, factor, what + ", released");
}

TEST(PulledJoints, NoUseExceedsTheLaw) {
  for (const double friction : {0.0, 0.3, 1.2}) {
    for (const double cohesion : {0.0, 2e4, 9e4, 5e5}) {
      Scene scene = hung(1.0, cohesion);
      scene.law = glue(friction, cohesion);
      const RigidModel model = scene.build().rigid_model(1.0, {});
      for (const double factor : {0.5, 1.0, 3.0}) {
        for (const JointUse use : {JointUse::pressed, JointUse::pulled}) {
          ConeStrength joint{friction / factor, 0.0, 0.0};
          for (const RigidPoint& point : model.points) {
            const ConeStrength one = strength_of(model, point, factor, use);
            joint.cohesion += one.cohesion * model.units.force();
            joint.tension += one.tension * model.units.force();
            joint.friction = std::min(joint.friction, one.friction);
          }
          EXPECT_LE(joint.tension, strength / factor * (1.0 + 1e-12));
          // The resistance to shear at any pressure, with an area of 1 m^2.
          for (double normal = -joint.tension; normal < 3e5; normal += 1e4)
            EXPECT_LE(joint.shear_bound(normal),
                      (cohesion + friction * std::max(normal, 0.0)) / factor * (1.0 + 1e-12));
          if (use == JointUse::pulled) {
            EXPECT_NEAR(joint.tension, strength / factor, 1e-6 * strength);
          } else {
            EXPECT_EQ(joint.friction, friction / factor);
          }
        }
      }
    }
  }
}

TEST(PulledJoints, AHungBoxNeedsNoCohesion) {
  // T A less the weight, for any cohesion, size and direction.
  for (const double width : {0.3, 1.0, 2.5}) {
    const double most = (strength * width - rock.density * g * 0.5 * width) / 1e3;
    for (const double cohesion : {0.0, 3e4, 1e6})
      expect_both(capacity(hung(width, cohesion)), most,
                  std::to_string(width) + " " + std::to_string(cohesion));
  }
  for (const Eigen::AngleAxisd& turn : {Eigen::AngleAxisd(0.8, Vector3(1, 2, 3).normalized()),
                                        Eigen::AngleAxisd(3.141592653589793, Vector3::UnitX())})
    expect_both(capacity(hung(1.0, 0.0).turned(turn)), (strength - rock.density * g * 0.5) / 1e3, "turned");
}

TEST(PulledJoints, AChainHangsByItsWeakestJoint) {
  // The upper joint, of half the area, carries both boxes and the load.
  Scene scene = hung(1.0, 0.0);
  scene.add("upper", Polyhedron(make_box({-0.25, -0.5, 0}, {0.25, 0.5, 1})));
  scene.blocks[1].solid = std::make_shared<const Polyhedron>(make_box({-4, -4, 1}, {4, 4, 2}));
  expect_both(capacity(scene), (strength * 0.5 - rock.density * g * (0.5 + 0.5)) / 1e3, "chain");
}

TEST(PulledJoints, TensionAddsNoFriction) {
  // A push of 1 kN at the foot of a box 1 x 1 x 0.5: mu W + c A, whatever T: mu (W + T A) would be far more.
  for (const double cohesion : {0.0, 1e4}) {
    Scene scene;
    scene.law = glue(0.4, cohesion);
    const int box = scene.add("box", Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 0.5})));
    scene.add_fixed(Polyhedron(make_box({-4, -4, -1}, {4, 4, 0})));
    load_at(scene, box, {-0.5, 0, 0}, {1e3, 0, 0});
    expect_both(capacity(scene), (0.4 * rock.density * g * 0.5 + cohesion) / 1e3, std::to_string(cohesion));
  }
}

TEST(PulledJoints, WithoutCohesionAHungBoxHasNoShear) {
  // Any push slides it; with cohesion, at most c A of it, and at least c (A - W/T).
  Scene scene = hung(1.0, 0.0);
  scene.blocks[0].loads.clear();
  load_at(scene, 0, {-0.5, 0, 0}, {1e3, 0, 0});
  const LimitAnswer none = capacity(scene);
  EXPECT_FALSE(none.released.lower);
  scene.law = glue(0.7, 2e4);
  const LimitAnswer some = capacity(scene);
  ASSERT_TRUE(some.released.lower && some.released.upper);
  EXPECT_LE(*some.released.lower, 20.0);
  EXPECT_GE(*some.released.upper, 20.0 * (1.0 - rock.density * g * 0.5 / strength) * (1.0 - 5e-4));
}

TEST(PulledJoints, EachJointHasItsOwnUse) {
  // A slab on a plane of 20 degrees beside a box below a roof: tan 35 / tan 20 of the slab, T A / W of the box.
  Scene scene;
  scene.law = glue(tangent_of(35.0), 0.0);
  scene.add("box", Polyhedron(make_box({10, 0, -0.5}, {11, 1, 0})));
  scene.add_fixed(Polyhedron(make_box({9, -1, 0}, {12, 2, 1})));
  scene.add("slab", tilted_box({-1, -0.5, 0}, {1, 0.5, 0.5}, 20.0));
  scene.add_fixed(tilted_box({-6, -2, -1}, {6, 2, 0}, 20.0));
  expect_both(scene.safety(), tangent_of(35.0) / tangent_of(20.0), "slab");
  scene.law = glue(tangent_of(80.0), 0.0);
  expect_both(scene.safety(), strength / (rock.density * g * 0.5), "box");
}

TEST(PulledJoints, MoreStrengthThanCohesionOverFrictionChangesNothingElsewhere) {
  // T above c/mu of a joint without tension: F = (W cos a tan phi + c A)/(W sin a).
  const double weight = rock.density * g, slope = std::atan(tangent_of(30.0));
  const double most = (weight * std::cos(slope) * 0.5 + 2.0 * 4e3) / (weight * std::sin(slope));
  expect_both(test_support::on_slope(30.0, glue(0.5, 4e3), 1).safety(), most, "slope");
}

}  // namespace
}  // namespace ashlar::pulled_joints_test
