// Accelerations of blocks that no equilibrium holds, against those of rigid blocks by hand.
#include <gtest/gtest.h>

#include <numbers>

#include "support/simulations.hpp"

namespace ashlar::rigid_onset_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;

constexpr double g = 9.81;

/// Blocks of a static analysis that ends as moving.
std::vector<MovingBlock> moving_blocks(BlockDefinition block, const JointLaw& law,
                                       const SimulationSettings& settings,
                                       const Vector3& floor_end = {4, 4, 0}) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(std::move(block));
  blocks.emplace_back(fixed_box({-4, -4, -1}, floor_end));
  Simulation simulation(std::move(blocks), {{}, {}}, test_support::same_law(law), settings);
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing) status = simulation.static_step(1.0);
  EXPECT_EQ(status, StaticStatus::moving);
  return simulation.moving_blocks();
}

/// A wall 1 m thick and 3 m high on a base tilted by `share` of its limit.
struct Wall {
  double share;
  double modulus;
  double stiffness;
  bool rigid = true;  ///< its stiffness is no joint's
  int order = 1;
  bool augmented = false;
};

/// Its angular acceleration about y.
double tipping(const Wall& wall) {
  SimulationSettings settings;
  settings.augmented = wall.augmented;
  settings.multipliers.penetration_tolerance = 1e-6;
  const double tilt = std::atan(wall.share / 3.0);
  settings.gravity = g * Vector3(std::sin(tilt), 0.0, -std::cos(tilt));
  JointLaw law{wall.stiffness, 0.5 * wall.stiffness, 1.0, 0.0, 0.0, true};
  law.rigid = wall.rigid;
  const auto moving = moving_blocks(
      block_of("wall", Polyhedron(make_box({-1, 0, 0}, {0, 1, 3})), {2500, wall.modulus, 0.2}, wall.order),
      law, settings);
  EXPECT_EQ(moving.size(), 1U);
  return moving.empty() ? 0.0 : moving[0].angular_acceleration.y();
}

TEST(RigidOnset, AWallTipsOverItsEdgeHoweverSoftItsSpringsAre) {
  // About the edge, m g (H/2 sin - B/2 cos) over m (B^2 + H^2)/3.
  for (const double share : {1.02, 1.2}) {
    const double tilt = std::atan(share / 3.0);
    const double expected = g * (1.5 * std::sin(tilt) - 0.5 * std::cos(tilt)) / (10.0 / 3.0);
    for (const double modulus : {1e9, 1e10, 1e12}) {
      for (const bool augmented : {false, true}) {
        Wall wall{share, modulus, 20.0 * modulus, true, 1, augmented};
        EXPECT_NEAR(tipping(wall) / expected, 1.0, 5e-3) << share << modulus << augmented;
        // Its edge yields like corners of blocks.
        wall.order = 2;
        EXPECT_NEAR(tipping(wall) / expected, 1.0, 2e-2) << share << modulus << augmented;
      }
    }
  }
}

/// The least angular acceleration on the way of the same wall, rigid on a joint of stiffness k: turned by t
/// it is pressed over c, N = k t c^2/2, which adds N c/3 + N t h, h = 1.5 m, to the moment about the edge.
/// Their sum is least where t^(3/2) = sqrt(2 N/k)/(6 h).
double over_the_pressed_strip(double share, double stiffness) {
  const double tilt = std::atan(share / 3.0);
  const double weight = 7500.0 * g;
  const double normal = weight * std::cos(tilt);
  const double turn = std::pow(std::sqrt(2.0 * normal / stiffness) / 9.0, 2.0 / 3.0);
  const double pressed = std::sqrt(2.0 * normal / (stiffness * turn));
  const double moment = weight * (1.5 * std::sin(tilt) - 0.5 * std::cos(tilt));
  return (moment + normal * (pressed / 3.0 + 1.5 * turn)) / (7500.0 * 10.0 / 3.0);
}

TEST(RigidOnset, AJointOfGivenStiffnessGivesWay) {
  EXPECT_NEAR(tipping({1.2, 1e10, 2e11, false}) / over_the_pressed_strip(1.2, 2e11), 1.0, 2e-2);
}

TEST(RigidOnset, WhereRigidBlocksWouldStayThoseThatGiveWayCount) {
  // Not by the motion of rigid ones on the way, which is zero where they stand on the edge. An iteration takes
  // the wall far: it sees the strip as it is at its end, and the weight's arm as at its start.
  EXPECT_NEAR(tipping({0.95, 1e10, 2e8}) / over_the_pressed_strip(0.95, 2e8), 1.0, 0.2);
}

TEST(RigidOnset, ItIsThatOfTheStartAlsoWhereBlocksTurnLater) {
  // A plate at the end of a slope of 25 degrees turns over the brink before it has gone far. At first g (sin
  // - cos tan phi), and the resultant, 0.04 m off its middle, does not turn it.
  const double degree = std::numbers::pi / 180.0;
  SimulationSettings settings;
  settings.gravity = g * Vector3(std::sin(25.0 * degree), 0.0, -std::cos(25.0 * degree));
  JointLaw law{2e11, 1e11, std::tan(15.0 * degree), 0.0, 0.0, true};
  law.rigid = true;
  const auto moving = moving_blocks(
      block_of("plate", Polyhedron(make_box({-0.5, -0.4, 0}, {0.5, 0.4, 0.3})), {2500, 1e10, 0.2}, 1), law,
      settings, {0.5, 0.6, 0});
  ASSERT_EQ(moving.size(), 1U);
  const double expected = g * (std::sin(25.0 * degree) - std::cos(25.0 * degree) * std::tan(15.0 * degree));
  EXPECT_NEAR(moving[0].acceleration.x(), expected, 1e-3 * expected);
  EXPECT_NEAR(moving[0].acceleration.z(), 0.0, 1e-3 * expected);
  EXPECT_NEAR(moving[0].angular_acceleration.y(), 0.0, 1e-3 * expected);
}

TEST(RigidOnset, ABondThatBreaksHoldsNoMore) {
  // A block on a slope of 45 degrees, bonded by a part of the necessary strength besides friction of 30 degrees: g (sin
  // - cos tan phi) once the bond is broken, for any residual at failure.
  SimulationSettings settings;
  settings.gravity = g * std::sqrt(0.5) * Vector3(1, 0, -1);
  const double friction = std::tan(std::numbers::pi / 6.0);
  const double expected = g * std::sqrt(0.5) * (1.0 - friction);
  for (const bool augmented : {false, true}) {
    settings.augmented = augmented;
    settings.multipliers.penetration_tolerance = 1e-6;
    for (const double time_step : {1e-2, 1e-3}) {
      settings.time_step = time_step;
      for (const double share : {0.5, 0.99, 1.05}) {
        // Where pressure is least its edge slides first, also if the mean would hold.
        const JointLaw law{2e11, 1e11, friction, share * 1250.0 * expected, 0.0, true};
        const auto moving = moving_blocks(
            block_of("block", Polyhedron(make_box({-2, 0, 0}, {0, 1, 0.5})), {2500, 1e10, 0.2}, 1), law,
            settings);
        ASSERT_EQ(moving.size(), 1U);
        EXPECT_NEAR(moving[0].acceleration.x(), expected, 1e-4 * expected) << share << time_step;
      }
    }
  }
}

}  // namespace
}  // namespace ashlar::rigid_onset_test
