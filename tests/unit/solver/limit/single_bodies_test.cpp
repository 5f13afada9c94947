// Motion of one body while the others are held.
#include "solver/limit/single_bodies.hpp"

#include <gtest/gtest.h>

#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::single_bodies_test {
namespace {

using test_support::joint;
using test_support::on_slope;
using test_support::tilted_box;

TEST(SingleBodies, BlocksOfATowerSlideOneAtATime) {
  test_support::LimitScene scene = on_slope(30.0, joint(0.4), 0);
  scene.add("B", tilted_box({-1, -0.5, 0.5}, {1, 0.5, 1.0}, 30.0));
  const RigidModel model = scene.build().rigid_model(1.0, {});
  SingleBodies single(model, std::vector<bool>(model.points.size(), true));
  // tan(30) = 0.577: friction 0.4 holds neither, 0.8 both.
  for (const BodyVelocity& velocity : single.motions({1.0, 1.0}, 1e-3)) EXPECT_GT(velocity.norm(), 0.0);
  for (const BodyVelocity& velocity : single.motions({0.5, 1.0}, 1e-3)) EXPECT_EQ(velocity.norm(), 0.0);
  // A body that stood with less strength is not tested again; one that moves with still less strength is found.
  for (const BodyVelocity& velocity : single.motions({0.6, 1.0}, 1e-3)) EXPECT_EQ(velocity.norm(), 0.0);
  const std::vector<std::vector<BodyVelocity>> sets = single.sets({1.0, 1.0}, 1e-3);
  ASSERT_EQ(sets.size(), 2U);  // they touch
  for (const std::vector<BodyVelocity>& set : sets) EXPECT_NE(set[0].norm() > 0.0, set[1].norm() > 0.0);
}

}  // namespace
}  // namespace ashlar::single_bodies_test
