// Early stop of a static analysis for certain motion, and motion that it must compute.
#include "solver/statics/certain_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/simulations.hpp"

namespace ashlar::certain_motion_test {
namespace {

using test_support::block_of;
using test_support::place_of;
using test_support::same_law;
using test_support::tilted_box;

const Material rock{2700.0, 1e10, 0.2};
constexpr double degree = std::numbers::pi / 180.0;
constexpr double incline = 30.0;

BlockDefinition fixed_block(Polyhedron solid) {
  BlockDefinition block = block_of("base", std::move(solid), rock, 1);
  block.fixed = true;
  return block;
}

/// A cube of 1 m without friction on a slope down to -x, and fixed blocks at some distances ahead. The compression of
/// springs of 1e10 N/m is micrometres. @param ways distances of the stops, m
/// @param cube_last the cube comes after all others, not before them
Simulation on_slope(const std::vector<double>& ways, bool cube_last = false) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(block_of("A", tilted_box({-0.5, -0.5, 0}, {0.5, 0.5, 1}, incline), rock, 1));
  blocks.emplace_back(fixed_block(tilted_box({-6, -2, -1}, {2, 2, 0}, incline)));
  for (const double travel : ways)
    blocks.emplace_back(
        fixed_block(tilted_box({-1.5 - travel, -2, 0.25}, {-0.5 - travel, 2, 0.75}, incline)));
  if (cube_last) std::rotate(blocks.begin(), blocks.begin() + 1, blocks.end());
  const std::vector<InitialMotion> at_rest(blocks.size());
  return Simulation(std::move(blocks), at_rest, same_law({1e10, 1e10, 0.0, 0.0, 0.0, true}), {});
}

StaticStatus run_static(Simulation& simulation, double far) {
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing) status = simulation.static_step(1.0, far);
  return status;
}

double way_of(const Simulation& simulation) {
  return (simulation.states()[0].position - simulation.blocks()[0].initial_state().position).norm();
}

TEST(CertainMotion, MotionWithoutObstacleStopsEarly) {
  // An iteration moves a block by 0.05 of its size at most, so that a full size would need 20.
  Simulation simulation = on_slope({});
  ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::moving);
  EXPECT_LT(simulation.steps(), 12);
  EXPECT_LT(way_of(simulation), 0.2);
  ASSERT_EQ(simulation.moving_blocks().size(), 1U);
  EXPECT_NEAR(simulation.moving_blocks()[0].acceleration.norm(), 9.81 * std::sin(incline * degree), 1e-3);
}

TEST(CertainMotion, AnObstacleAheadIsDetected) {
  // 0.3 m: no contact is detected. 5e-4 m: half the contact distance, with an open contact.
  for (const double travel : {0.3, 5e-4}) {
    for (const bool cube_last : {false, true}) {
      Simulation simulation = on_slope({travel}, cube_last);
      const std::size_t cube = cube_last ? 2 : 0;
      const Vector3 start = place_of(simulation, cube, {0, 0, 0});
      ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium) << travel << cube_last;
      EXPECT_NEAR((place_of(simulation, cube, {0, 0, 0}) - start).norm(), travel, 1e-5);
    }
  }
}

TEST(CertainMotion, AnObstacleBeyondTheRequestedDistanceIsNot) {
  Simulation simulation = on_slope({0.3});
  EXPECT_EQ(run_static(simulation, 0.1), StaticStatus::moving);
  EXPECT_LT(way_of(simulation), 0.1);
}

TEST(CertainMotion, ABlockBehindAStoppedOneIsStopped) {
  // Two cubes, one after the other, both without friction: the lower one has 5e-4 m to go.
  std::vector<BlockModel> blocks;
  blocks.emplace_back(block_of("A", tilted_box({-0.5, -0.5, 0}, {0.5, 0.5, 1}, incline), rock, 1));
  blocks.emplace_back(block_of("B", tilted_box({0.5, -0.5, 0}, {1.5, 0.5, 1}, incline), rock, 1));
  blocks.emplace_back(fixed_block(tilted_box({-6, -2, -1}, {2, 2, 0}, incline)));
  blocks.emplace_back(fixed_block(tilted_box({-1.5, -2, 0.25}, {-0.5 - 5e-4, 2, 0.75}, incline)));
  Simulation simulation(std::move(blocks), {{}, {}, {}, {}}, same_law({1e10, 1e10, 0.0, 0.0, 0.0, true}), {});
  EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
}

TEST(CertainMotion, ComplianceIsNoMotion) {
  // Springs of 1e6 N/m support the weight of 26.5 kN by a compression of 26 mm: far from its place, and in equilibrium.
  std::vector<BlockModel> blocks;
  blocks.emplace_back(block_of("A", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), rock, 1));
  blocks.emplace_back(fixed_block(Polyhedron(make_box({-1, -1, -1}, {2, 2, 0}))));
  JointLaw law{1e6, 1e6, 0.5, 0.0, 0.0, true};
  SimulationSettings settings;
  settings.depth.allowed_depth = 0.2;
  Simulation simulation(std::move(blocks), {{}, {}}, same_law(law), settings);
  ASSERT_EQ(run_static(simulation, 0.1), StaticStatus::equilibrium);
  EXPECT_NEAR(place_of(simulation, 0, {0.5, 0.5, 0.5}).z(), 0.5 - 2700.0 * 9.81 / 1e6, 1e-4);
}

}  // namespace
}  // namespace ashlar::certain_motion_test
