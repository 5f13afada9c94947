// Rigid blocks in finite displacements: what paths along supports and pushes share.
#include "solver/paths/followed_blocks.hpp"

#include <gtest/gtest.h>

#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::followed_blocks_test {
namespace {

using test_support::joint;
using test_support::LimitScene;

/// Two cubes on the ground, half a metre apart.
LimitScene two_cubes() {
  LimitScene scene;
  scene.law = joint(1.0);
  scene.add("one", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})));
  scene.add("two", Polyhedron(make_box({1.5, 0, 0}, {2.5, 1, 1})));
  scene.add_fixed(Polyhedron(make_box({-3, -1, -1}, {5, 2, 0})));
  return scene;
}

TEST(FollowedBlocks, KnowWhichOfThemMove) {
  const Simulation simulation = two_cubes().build();
  const PlacedScene scene{simulation.system(), simulation.states(), simulation.histories(), 1.0, 1};
  const FollowedBlocks blocks(scene, 0.05);
  const RigidModel model = blocks.model_of(blocks.as_placed());
  ASSERT_EQ(model.bodies.size(), 2U);
  std::vector<BodyVelocity> velocity(2, BodyVelocity::Zero());
  velocity[1][0] = 1.0;
  EXPECT_EQ(blocks.moving_blocks(model, velocity), std::vector<int>{1});
  velocity[0][0] = 0.005;
  EXPECT_EQ(blocks.moving_blocks(model, velocity), std::vector<int>{1}) << "a two-hundredth of the fastest";
  velocity[0][0] = 0.5;
  EXPECT_EQ(blocks.moving_blocks(model, velocity), (std::vector<int>{0, 1}));
}

TEST(FollowedBlocks, MultiplyTheLoadsOfSome) {
  LimitScene cubes = two_cubes();
  cubes.blocks[1].loads.push_back({Vector3(1.5, 0.5, 1.0), false, {100, 0, 0}, {}});
  const Simulation simulation = cubes.build();
  const PlacedScene scene{simulation.system(), simulation.states(), simulation.histories(), 1.0, 1};
  const FollowedBlocks blocks(scene, 0.05);
  EXPECT_FALSE(multiplies_loads(blocks.model_of(blocks.as_placed())));
  const RigidModel model = blocks.model_of(blocks.as_placed(), {false, true, false});
  EXPECT_EQ(model.multiplied[0].norm(), 0.0);
  EXPECT_GT(model.multiplied[1].norm(), 0.0);
}

TEST(FollowedBlocks, GapsOverALengthEndAtAThousand) {
  RigidModel model;
  const std::vector<double> gaps = {-0.5, 0.0, 2.0, 1e6};
  model.points = std::vector<RigidPoint>(gaps.size());
  for (std::size_t k = 0; k < gaps.size(); ++k) model.points[k].contact.gap = gaps[k];
  EXPECT_EQ(gaps_over(model, 0.5), (std::vector<double>{-1.0, 0.0, 4.0, 1e3}));
}

TEST(FollowedBlocks, TimesScalesEachMotion) {
  const std::vector<BodyVelocity> travel = times(3.0, {BodyVelocity::Ones(), 2.0 * BodyVelocity::Ones()});
  EXPECT_EQ(travel[0], BodyVelocity(3.0 * BodyVelocity::Ones()));
  EXPECT_EQ(travel[1], BodyVelocity(6.0 * BodyVelocity::Ones()));
}

TEST(FollowedBlocks, CannotBalanceAPushBeyondFriction) {
  const Simulation simulation = two_cubes().build();
  const RigidModel model = simulation.rigid_model(1.0);
  ConeProgram program = program_of(model, 1);
  EXPECT_FALSE(cannot_balance(program, model.steady));
  std::vector<BodyVelocity> load = model.steady;
  BodyVelocity wrench = BodyVelocity::Zero();
  wrench[0] = 1.5 * model.bodies[0].mass * test_support::g;
  load[0] += model.bodies[0].motion.transpose() * wrench / model.units.force();
  EXPECT_TRUE(cannot_balance(program, load));
}

}  // namespace
}  // namespace ashlar::followed_blocks_test
