// Inadmissible end states of a step, and the end of the run with the last valid state.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/simulations.hpp"

namespace ashlar::end_state_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::same_law;

JointLaw law_of(double stiffness, bool given) {
  JointLaw law{stiffness, 0.5 * stiffness, 0.5, 0.0, 0.0, true};
  law.rigid = !given;
  return law;
}

/// A cube of 1 m and a mass of 2500 kg on a floor under some gravity, in its first 0.2 s.
struct Drop {
  double young_modulus = 1e9;
  double gravity = 9.81;
  double speed = 0.0;  ///< downwards
  JointLaw law = law_of(2e10, false);
  double allowed_depth = 0.0;
};

Simulation simulation_of(const Drop& drop) {
  SimulationSettings settings;
  settings.gravity = Vector3(0, 0, -drop.gravity);
  settings.contact_distance = 1e-3;
  settings.depth.allowed_depth = drop.allowed_depth;
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-2, -2, -1}, {3, 3, 0}));
  blocks.emplace_back(
      block_of("cube", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2500.0, drop.young_modulus, 0.2}, 1));
  return {
      std::move(blocks), {{}, {Vector3(0, 0, -drop.speed), Vector3::Zero()}}, same_law(drop.law), settings};
}

TEST(EndState, TheTrueDepthOfACubeAtRestIsItsWeightOverItsStiffness) {
  Drop drop;
  drop.law = law_of(1e9, true);
  Simulation simulation = simulation_of(drop);
  double deepest = 0.0;
  while (!simulation.reached(0.2)) {
    ASSERT_EQ(simulation.step(0.2), StepStatus::accepted);
    EXPECT_NEAR(simulation.report().depth, simulation.report().penetration, 1e-12);
    deepest = std::max(deepest, simulation.report().depth);
  }
  EXPECT_EQ(simulation.deepest().depth, deepest);
  EXPECT_EQ(simulation.deepest().blocks, (std::array{1, 0}));
  EXPECT_GT(deepest, 2500.0 * 9.81 / 1e9);
}

TEST(EndState, ACubeThatIsPressedThroughItsFloorFails) {
  // Springs that the program chose hold 1e6 times its weight 1.2 m deep.
  Drop drop;
  drop.gravity = 1e7;
  Simulation simulation = simulation_of(drop);
  EXPECT_FALSE(test_support::run_until(simulation, 0.2));
  ASSERT_TRUE(simulation.fault());
  EXPECT_EQ(simulation.fault()->reason, RejectionReason::too_deep);
  EXPECT_EQ(simulation.fault()->blocks, (std::array{1, 0}));
  EXPECT_NEAR(simulation.fault()->allowed, 0.1, 1e-15);
  EXPECT_GT(simulation.fault()->depth, 0.1);
  // The last accepted state is one that is allowed.
  EXPECT_LE(simulation.deepest().depth, 0.1);
}

TEST(EndState, SpringsOfAGivenStiffnessMayGiveWay) {
  // 2500 kg on 2e5 N/m: at rest at 0.123 m, twice that on the way.
  Drop drop;
  drop.law = law_of(2e5, true);
  Simulation given = simulation_of(drop);
  EXPECT_TRUE(test_support::run_until(given, 0.2));
  EXPECT_GT(given.deepest().share, 0.12);
  drop.law = law_of(2e5, false);
  Simulation chosen = simulation_of(drop);
  EXPECT_FALSE(test_support::run_until(chosen, 0.2));
  drop.allowed_depth = 0.3;
  Simulation allowed = simulation_of(drop);
  EXPECT_TRUE(test_support::run_until(allowed, 0.2));
}

TEST(EndState, SoftAndFastBlocksFailOrStayWhatTheyAre) {
  for (const Drop& drop : {Drop{1e4, 98.1, 0.0, law_of(2e5, false)}, Drop{1e4, 1e3, 50.0, law_of(2e5, false)},
                           Drop{1e9, 9.81, 1e5}, Drop{1e9, 1e10, 0.0}}) {
    Simulation simulation = simulation_of(drop);
    EXPECT_FALSE(test_support::run_until(simulation, 0.2)) << drop.young_modulus << ' ' << drop.speed;
    EXPECT_TRUE(simulation.fault());
    EXPECT_LE(simulation.deepest().depth, 0.1);
    for (const BlockState& state : simulation.states()) EXPECT_TRUE(state.position.allFinite());
    const Eigen::Matrix3d gradient = simulation.states()[1].position.transpose() *
                                     simulation.blocks()[1].basis().gradients(Vector3(0.5, 0.5, 0.5));
    EXPECT_GT(gradient.determinant(), 0.0);
  }
}

/// A free cube of 1 m, or what else is given, in its first 5 ms.
Simulation lone(const Vector3& size, const Vector3& gravity, const Vector3& force) {
  SimulationSettings settings;
  settings.gravity = gravity;
  BlockDefinition block =
      block_of("lone", Polyhedron(make_box(Vector3::Zero(), size)), {2700.0, 1e10, 0.2}, 1);
  if (!force.isZero(0.0)) block.loads.push_back({size, false, force, {}});
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(block));
  return {std::move(blocks), {{}}, same_law({}), settings};
}

TEST(EndState, WhatDoublesCannotHoldIsNoState) {
  const Vector3 cube = Vector3::Ones(), none = Vector3::Zero();
  struct Case {
    Vector3 gravity, force;
  };
  for (const auto& [gravity, force] : {Case{none, {1e300, 0, 0}}, Case{{0, 0, -1e30}, none},
                                       Case{{0, 0, -1e160}, none}, Case{none, {0, 1e160, 0}}}) {
    Simulation simulation = lone(cube, gravity, force);
    EXPECT_FALSE(test_support::run_until(simulation, 0.005));
    ASSERT_TRUE(simulation.fault());
    EXPECT_EQ(simulation.fault()->reason, RejectionReason::not_finite);
    EXPECT_EQ(simulation.fault()->blocks[0], 0);
    EXPECT_EQ(simulation.rejections().back().reason, RejectionReason::not_finite);
    for (const BlockState& state : simulation.states()) {
      EXPECT_TRUE(state.position.allFinite());
      EXPECT_TRUE(state.velocity.allFinite());
    }
    EXPECT_TRUE(std::isfinite(simulation.ledger().kinetic));
  }
}

TEST(EndState, ANeedleThatIsTooThinToSpinFalls) {
  // Its moment of inertia about its axis is 1e-16 of the others.
  Simulation simulation = lone({1, 1, 1e8}, {0, 0, -9.81}, Vector3::Zero());
  ASSERT_TRUE(test_support::run_until(simulation, 0.005));
  const BlockState& state = simulation.states()[0];
  EXPECT_TRUE(state.position.allFinite());
  EXPECT_TRUE(state.velocity.allFinite());
  EXPECT_NEAR(simulation.blocks()[0].momentum(state).z() / (2700.0 * 1e8 * -9.81 * 0.005), 1.0, 1e-6);
}

}  // namespace
}  // namespace ashlar::end_state_test
