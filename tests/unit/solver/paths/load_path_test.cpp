#include "solver/paths/load_path.hpp"

#include <gtest/gtest.h>

#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::load_path_test {
namespace {

using namespace test_support;

LoadPath path_of(const LimitScene& scene, const std::vector<bool>& multiplied = {}, double allowed = 0.01) {
  RigidModel model = scene.build().spring_model(1.0, multiplied);
  std::vector<double> displacements(model.bodies.size(), allowed);
  return LoadPath(
      std::move(model), [](int, int) { return true; }, std::move(displacements));
}

TEST(LoadPath, BlockOnASlopeRestsBelowItsFrictionAngle) {
  const LimitScene scene = on_slope(30.0, joint(1.001 * tangent_of(30.0)), 0);
  LoadPath path = path_of(scene);
  EXPECT_EQ(path.to(path.unloaded(), {1.0, 1.0}).outcome, LimitOutcome::stands);
  const PathTrial slides = path.to(path.unloaded(), {1.002, 1.0});
  ASSERT_EQ(slides.outcome, LimitOutcome::moves);
  const LimitTrial motion = path.motion_of(slides, {1.002, 1.0});
  EXPECT_EQ(motion.outcome, LimitOutcome::moves);
}

TEST(LoadPath, TiltedBlockTopplesAboutItsEdge) {
  // A column of 0.5 x 0.5 x 2 m topples at a slope of tan = 0.25.
  for (const double share : {0.995, 1.005}) {
    LimitScene scene;
    scene.law = joint(1.0);
    const double incline = 180.0 / std::numbers::pi * std::atan(share * 0.25);
    scene.add("column", tilted_box({-0.25, -0.25, 0}, {0.25, 0.25, 2.0}, incline));
    scene.add_fixed(tilted_box({-2, -2, -1}, {2, 2, 0}, incline));
    LoadPath path = path_of(scene);
    EXPECT_EQ(path.to(path.unloaded(), {}).outcome, share < 1.0 ? LimitOutcome::stands : LimitOutcome::moves);
  }
}

TEST(LoadPath, KeepsForcesOfRestFromStateToState) {
  LoadPath path = path_of(on_slope(20.0, joint(0.6), 0));
  const PathTrial rest = path.to(path.unloaded(), {});
  ASSERT_EQ(rest.outcome, LimitOutcome::stands);
  const PathTrial again = path.to(rest.end, {});
  ASSERT_EQ(again.outcome, LimitOutcome::stands);
  EXPECT_NEAR(again.end.displacement, rest.end.displacement, 1e-12);
}

TEST(LoadPath, JointsYieldOnceTheySlide) {
  LoadPath path = path_of(on_slope(30.0, joint(1.001 * tangent_of(30.0)), 0));
  const PathTrial rest = path.to(path.unloaded(), {0.1, 1.0});
  ASSERT_EQ(rest.outcome, LimitOutcome::stands);
  EXPECT_TRUE(path.yielding_joints(rest.end, rest).empty());
  const PathTrial slides = path.to(rest.end, {1.01, 1.0});
  EXPECT_EQ(path.yielding_joints(rest.end, slides), (std::vector<PairKey>{{0, 1}}));
}

TEST(LoadPath, AnswerDoesNotDependOnTheOrderOfBlocks) {
  LimitScene scene = on_slope(30.0, joint(1.001 * tangent_of(30.0)), 0);
  scene.add("B", tilted_box({1.5, -0.5, 0}, {2.5, 0.5, 0.5}, 30.0));
  LoadPath path = path_of(scene), other = path_of(scene.reordered({2, 1, 0}));
  for (const double factor : {0.9, 1.1})
    EXPECT_EQ(path.to(path.unloaded(), {factor, 1.0}).outcome,
              other.to(other.unloaded(), {factor, 1.0}).outcome);
}

}  // namespace
}  // namespace ashlar::load_path_test
