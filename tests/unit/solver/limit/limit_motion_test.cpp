// Mechanisms of motions known by hand.
#include "solver/limit/limit_motion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::limit_motion_test {
namespace {

using test_support::g;
using test_support::groove;
using test_support::joint;
using test_support::on_slope;
using test_support::tilted_box;
using Scene = test_support::LimitScene;

std::string mode_of(const Scene& scene) {
  LimitAnalysis analysis = scene.analysis();
  const LimitTrial trial = analysis.released({});
  EXPECT_EQ(trial.outcome, LimitOutcome::moves);
  return analysis.motion_of(trial).mode;
}

TEST(LimitMotion, ModesHaveWords) {
  EXPECT_EQ(mode_of(on_slope(30.0, joint(0.4), 0)), "slides on one plane");
  EXPECT_EQ(mode_of(groove(35.0, 0.3)), "slides along two planes");
  Scene tower;
  tower.law = joint(1.0);
  tower.add("tower", tilted_box({0, 0, 0}, {1, 1, 3}, 25.0));
  tower.add_fixed(tilted_box({-6, -2, -1}, {6, 2, 0}, 25.0));
  EXPECT_EQ(mode_of(tower), "topples");
  Scene ceiling;
  ceiling.add_fixed(Polyhedron(make_box({-2, -2, 1}, {2, 2, 2})));
  ceiling.add("below", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})));
  EXPECT_EQ(mode_of(ceiling), "falls");
}

TEST(LimitMotion, JointsOfAMotionAreNamed) {
  LimitAnalysis analysis = on_slope(30.0, joint(0.4), 0).analysis();
  const LimitTrial trial = analysis.released({});
  const LimitMotion motion = analysis.motion_of(trial);
  ASSERT_EQ(motion.joints.size(), 1U);
  EXPECT_EQ(motion.joints[0].blocks, (PairKey{0, 1}));
  EXPECT_EQ(motion.joints[0].motion, JointMotion::slides);
  ASSERT_EQ(motion.blocks.size(), 1U);
  // g (sin a - cos a tan phi) down the slope.
  const double slope = std::numbers::pi / 6.0;
  EXPECT_NEAR(motion.blocks[0].acceleration.norm() / (g * (std::sin(slope) - 0.4 * std::cos(slope))), 1.0,
              5e-3);
}

}  // namespace
}  // namespace ashlar::limit_motion_test
