// Rigid blocks that do not stand, followed to where they go.
#include "solver/paths/followed_collapse.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::followed_collapse_test {
namespace {

using test_support::g;
using test_support::joint;
using test_support::LimitScene;

/// A cube of 1 m on a floor under gravity that is inclined by a slope, and a stop at some distance before it.
LimitScene cube(double friction, double slope, double stop) {
  LimitScene scene;
  scene.law = joint(friction);
  scene.gravity = Vector3(g * std::sin(slope), 0.0, -g * std::cos(slope));
  scene.add("cube", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})));
  scene.add_fixed(Polyhedron(make_box({-5, -5, -1}, {9, 6, 0})));
  if (stop < 5.0) scene.add_fixed(Polyhedron(make_box({1.0 + stop, -1, 0}, {3.0 + stop, 2, 1})));
  return scene;
}

Collapse followed(const LimitScene& scene, double far) {
  const Simulation simulation = scene.build();
  return follow_collapse({simulation.system(), simulation.states(), simulation.histories(), 1.0, 1}, far);
}

TEST(FollowedCollapse, WhatSlidesGoesFar) {
  const Collapse collapse = followed(cube(0.5, std::atan(0.6), 9.0), 1.0);
  EXPECT_EQ(collapse.end, CollapseEnd::goes_far);
  EXPECT_GE(collapse.displacements.at(0), 1.0);
  EXPECT_LT(collapse.displacements.at(0), 1.2);
}

// Just beyond the limit as well: the motion of a step has a length, not a time.
TEST(FollowedCollapse, WhatStartsSlowlyGoesFar) {
  EXPECT_EQ(followed(cube(0.5, std::atan(0.501), 9.0), 1.0).end, CollapseEnd::goes_far);
}

TEST(FollowedCollapse, WhatStandsRests) {
  const Collapse collapse = followed(cube(0.5, std::atan(0.49), 9.0), 1.0);
  EXPECT_EQ(collapse.end, CollapseEnd::rests);
  EXPECT_LT(collapse.programmes, 10);
}

// A stop farther than the points of a step are seen, 0.2 sizes: the cube rests at it, after the way to it.
TEST(FollowedCollapse, WhatMeetsAStopRestsThere) {
  const Collapse collapse = followed(cube(0.5, std::atan(0.7), 0.35), 1.0);
  EXPECT_EQ(collapse.end, CollapseEnd::rests);
  EXPECT_NEAR(collapse.displacements.at(0), 0.35, 2e-3);
}

// Friction that holds, but the weight passes the edge: the cube tips. A stop at its top holds it after little motion.
TEST(FollowedCollapse, WhatTipsGoesFarUnlessItIsHeld) {
  const double steep = std::atan(1.02);
  EXPECT_EQ(followed(cube(2.0, steep, 9.0), 0.5).end, CollapseEnd::goes_far);
  EXPECT_EQ(followed(cube(2.0, steep, 0.05), 0.5).end, CollapseEnd::rests);
}

}  // namespace
}  // namespace ashlar::followed_collapse_test
