// Steps of pushed blocks.
#include "solver/paths/pushed_blocks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/index.hpp"
#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::pushed_blocks_test {
namespace {

using test_support::joint;
using test_support::LimitScene;

/// A block of 0.5 m x 1 m x 2 m on the ground, pushed along x.
struct Standing {
  explicit Standing(double friction = 1.0)
      : simulation(scene_of(friction).build()),
        scene{simulation.system(), simulation.states(), simulation.histories(), 1.0, 1},
        lengths(1.0, 1e-3),
        blocks(scene, {}, lengths) {}

  static LimitScene scene_of(double friction) {
    LimitScene made;
    made.law = joint(friction);
    made.add("block", Polyhedron(make_box({0, 0, 0}, {0.5, 1, 2})));
    made.add_fixed(Polyhedron(make_box({-3, -1, -1}, {3, 2, 0})));
    return made;
  }
  [[nodiscard]] Vector3 corner(const PushedPlace& place) const {
    return PlacedBlock(simulation.blocks()[0], place.placement.states[0].position).place({0.5, 0.5, 0.0});
  }

  Simulation simulation;
  PlacedScene scene;
  PathLengths lengths;
  PushedBlocks blocks;
};

TEST(PushedBlocks, BeginAtTheLimitState) {
  Standing standing;
  const auto place = standing.blocks.start();
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->multiplier, 0.25, 1e-6);
  // About the edge: the top moves along, the foot does not.
  const Vector3 top = velocity_at(place->model, place->velocity, 0, {0.5, 0.5, 2.0});
  const Vector3 foot = velocity_at(place->model, place->velocity, 0, {0.5, 0.5, 0.0});
  EXPECT_GT(top.x(), 0.1);
  EXPECT_LT(foot.norm(), 1e-5 * top.x());
  EXPECT_EQ(velocity_at(place->model, place->velocity, 1, {0, 0, 0}), Vector3::Zero());
}

TEST(PushedBlocks, TurnAboutAnEdgeThatStays) {
  Standing standing;
  auto place = standing.blocks.start();
  ASSERT_TRUE(place);
  for (int k = 0; k < 5; ++k) {
    place = standing.blocks.advanced(*place, standing.lengths.longest_step);
    ASSERT_TRUE(place);
    EXPECT_LT((standing.corner(*place) - Vector3(0.5, 0.5, 0.0)).norm(), 1e-8);
    EXPECT_GT(standing.blocks.last_travel(), 0.0);
  }
  EXPECT_LT(place->multiplier, 0.25);
}

TEST(PushedBlocks, CloseWhatFrictionOpens) {
  Standing standing(0.2);
  auto place = standing.blocks.start();
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->multiplier, 0.2, 1e-6);
  place = standing.blocks.advanced(*place, 0.5 * standing.lengths.longest_step);
  ASSERT_TRUE(place);
  EXPECT_NEAR(standing.corner(*place).z(), 0.0, 2.0 * standing.lengths.closed);
  EXPECT_GT(standing.corner(*place).x(), 0.5);
}

TEST(PushedBlocks, CannotBeFollowedBeyondTheReach) {
  Standing standing;
  auto place = standing.blocks.start();
  ASSERT_TRUE(place);
  EXPECT_FALSE(standing.blocks.advanced(*place, 20.0 * standing.lengths.longest_step));
  EXPECT_EQ(standing.blocks.failure(), PushFailure::far);
  EXPECT_FALSE(standing.blocks.falls_at_failure(1.0)) << "the step went too far, nothing else is known";
}

TEST(PushedBlocks, SettleWhereTheyAre) {
  Standing standing;
  const auto place = standing.blocks.start();
  ASSERT_TRUE(place);
  const auto again = standing.blocks.equilibrium_from(place->placement, standing.lengths.farthest);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->placement.states[0].position, place->placement.states[0].position);
  EXPECT_NEAR(again->multiplier, place->multiplier, 1e-7);
}

}  // namespace
}  // namespace ashlar::pushed_blocks_test
