// Steps that a plain Newton iteration cannot take: many contacts that open, stick and slide at once, joints
// that break.
#include "solver/step/solve/open_close.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "geometry/cutting/cut_solid.hpp"
#include "support/simulations.hpp"

namespace ashlar::open_close_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::place_of;
using test_support::run_until;
using test_support::same_law;

/// Convex stone about a centre, 0.2 to 0.5 m out.
Polyhedron stone(std::mt19937_64& random, const Vector3& center) {
  const auto share = [&] { return static_cast<double>(random() % 2001) / 1000.0 - 1.0; };
  std::vector<Vector3> points;
  while (points.size() < 14) {
    const Vector3 direction(share(), share(), share());
    if (direction.norm() > 0.2 && direction.norm() < 1.0)
      points.emplace_back(center + 0.5 * direction / std::max(direction.norm(), 0.4));
  }
  return Polyhedron(make_convex_hull(points));
}

/// Eight stones fall on each other for 0.8 s. @return times the fallback was needed
std::uint64_t pile_of_stones(unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-5, -5, -1}, {5, 5, 0}));
  for (int k = 0; k < 8; ++k) {
    const Vector3 center(1.05 * (k % 2), 1.05 * (k / 2 % 2), k < 4 ? 0.6 : 1.7);
    blocks.emplace_back(block_of("stone", stone(random, center), {2600, 1e9, 0.2}, 1));
  }
  SimulationSettings settings;
  settings.time_step = 2e-3;
  Simulation simulation(std::move(blocks), std::vector<InitialMotion>(9),
                        same_law({2e11, 1e11, 0.6, 0.0, 0.0, true}), settings);
  EXPECT_TRUE(run_until(simulation, 0.8));
  for (const Rejection& rejection : simulation.rejections())
    EXPECT_EQ(rejection.reason, RejectionReason::passing) << rejection.time;
  return simulation.counts().open_close_fallbacks;
}

TEST(OpenClose, NoStepOfAPileOfStonesIsCutForNotSettling) {
  std::uint64_t fallbacks = 0;
  for (const unsigned seed : {11U, 12U, 13U, 14U, 15U, 16U}) fallbacks += pile_of_stones(seed);
  // Newton alone does not always do.
  EXPECT_GT(fallbacks, 0U);
}

/// Fall of a cube of 1 m that hangs bonded under a ceiling, after ten steps of 0.1 s. Its weight is 24525 Pa
/// over the joint.
double fall_under_ceiling(double tensile_strength, double cohesion) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-2, -2, 1}, {2, 2, 2}));
  blocks.emplace_back(block_of("cube", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2500, 1e9, 0.2}, 1));
  SimulationSettings settings;
  settings.time_step = 0.1;
  Simulation simulation(std::move(blocks), std::vector<InitialMotion>(2),
                        same_law({1e9, 1e9, 0.5, cohesion, tensile_strength, true}), settings);
  EXPECT_TRUE(run_until(simulation, 1.0));
  return 0.5 - place_of(simulation, 1, {0.5, 0.5, 0.5}).z();
}

TEST(OpenClose, AJointBreaksWhereTheBalancedPullExceedsItsStrength) {
  // The predictor of each step, free fall, is far beyond the strength either way. What the step's damping
  // leaves of the sudden start adds 0.1 %.
  for (const double cohesion : {5e4, 0.0}) {
    EXPECT_LT(fall_under_ceiling(1.01 * 24525.0, cohesion), 1e-4);
    EXPECT_NEAR(fall_under_ceiling(0.99 * 24525.0, cohesion), 4.905, 1e-3);
  }
}

/// A plate of 1 m^2 and 500 kg on level ground, under gravity that has a horizontal part too: no tilting.
/// @param pull m/s^2, from rest. @return how far it has gone after 0.2 s
double pulled_along(const JointLaw& law, double pull) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-3, -3, -1}, {9, 3, 0}));
  blocks.emplace_back(block_of("plate", Polyhedron(make_box({0, 0, 0}, {1, 1, 0.2})), {2500, 1e9, 0.2}, 1));
  SimulationSettings settings;
  settings.time_step = 2.5e-4;
  settings.gravity.x() = pull;
  Simulation simulation(std::move(blocks), std::vector<InitialMotion>(2), same_law(law), settings);
  EXPECT_TRUE(run_until(simulation, 0.2));
  return place_of(simulation, 1, {0.5, 0.5, 0.1}).x() - 0.5;
}

TEST(OpenClose, WhatSlidesHasItsResidualStrength) {
  // Peak strength 0.5 * 4905 + 5000 = 7452.5 N, residual 0.25 * 4905 + 1000 = 2226.25 N. The peak is reached after
  // d = 7452.5 N / 1e10 N/m, with the speed v of m v^2 / 2 = 8000 N d - 1e10 N/m d^2 / 2.
  const double d = 7452.5 / 1e10;
  const double v = std::sqrt(2.0 / 500.0 * (8000.0 * d - 0.5e10 * d * d));
  const auto slid = [&](double strength) { return 0.2 * v + 0.5 * (16.0 - strength / 500.0) * 0.04; };
  JointLaw law{1e10, 1e10, 0.5, 5e3, 0.0, true};
  law.residual = ResidualStrength{0.25, 1e3, 0.0};
  EXPECT_LT(pulled_along(law, 7.0), 2e-6);  // 3500 N, twice that in the first swing
  EXPECT_NEAR(pulled_along(law, 16.0), slid(2226.25), 0.01 * slid(2226.25));
  // Perfectly plastic, and brittle.
  law.residual = ResidualStrength{0.5, 5e3, 0.0};
  EXPECT_NEAR(pulled_along(law, 16.0), slid(7452.5), 0.01 * slid(7452.5));
  law.residual.reset();
  EXPECT_NEAR(pulled_along(law, 16.0), slid(2452.5), 0.01 * slid(2452.5));
}

TEST(OpenClose, ABlockThatLiftsOffLeavesItsCohesion) {
  for (const auto& [integrator, augmented] :
       {std::pair(Integrator::dda, false), std::pair(Integrator::dda, true),
        std::pair(Integrator::average_acceleration, false)}) {
    std::vector<BlockModel> blocks;
    blocks.emplace_back(fixed_box({-2, -2, -1}, {3, 3, 0}));
    blocks.emplace_back(block_of("cube", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2500, 1e9, 0.2}, 1));
    SimulationSettings settings;
    settings.time_step = 1e-3;
    settings.integrator = integrator;
    settings.augmented = augmented;
    InitialMotion off;
    off.velocity = {0.2, 0.0, 1.0};
    Simulation simulation(std::move(blocks), {InitialMotion{}, off},
                          same_law({1e10, 1e10, 0.5, 1e6, 0.0, true}), settings);
    ASSERT_EQ(simulation.step(1.0), StepStatus::accepted);
    // Free flight: v t + g t^2/2.
    const Vector3 moved = place_of(simulation, 1, {0.5, 0.5, 0.5}) - Vector3(0.5, 0.5, 0.5);
    EXPECT_LT((moved - Vector3(2e-4, 0.0, 1e-3 - 0.5 * 9.81e-6)).norm(), 1e-13) << augmented;
  }
}

TEST(OpenClose, ASlidingBlockNeedsFewIterations) {
  // Friction's dependence on the normal force is in the Jacobian: no linear convergence in tan(phi).
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-5, -5, -1}, {5, 5, 0}));
  blocks.emplace_back(block_of("cube", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2500, 1e9, 0.2}, 1));
  SimulationSettings settings;
  settings.time_step = 1e-3;
  InitialMotion sliding;
  sliding.velocity = {1.0, 0.5, 0.0};
  Simulation simulation(std::move(blocks), {InitialMotion{}, sliding},
                        same_law({1e10, 1e10, 0.7, 0.0, 0.0, true}), settings);
  ASSERT_TRUE(run_until(simulation, 0.05));
  EXPECT_GT(simulation.report().sliding, 0);
  EXPECT_EQ(simulation.report().locked, 0);
  EXPECT_LE(simulation.counts().open_close_iterations, 6U * 50U);
}

// Joints much stiffer than the step can follow vibrate: the velocity turns round in each step, and where it
// would take the bricks is of no use as a first guess. What stays where it is has the states of the last
// step.
TEST(OpenClose, AWallAtRestIsGuessedToStay) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-1, -1, -0.5}, {3, 1, 0}));
  for (int row = 0; row < 3; ++row) {
    const double low = 0.25 * row;
    const std::vector<double> ends =
        row == 1 ? std::vector{0.0, 0.25, 0.75, 1.25, 1.5} : std::vector{0.0, 0.5, 1.0, 1.5};
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
      blocks.emplace_back(block_of("brick",
                                   Polyhedron(make_box({ends[k], 0, low}, {ends[k + 1], 0.25, low + 0.25})),
                                   {2500, 5e10, 0.2}, 1));
  }
  SimulationSettings settings;
  settings.time_step = 2e-3;
  std::vector<InitialMotion> at_rest(blocks.size());
  Simulation simulation(std::move(blocks), at_rest, same_law({2e13, 1e13, 0.7, 0.0, 0.0, true}), settings);
  for (int step = 1; step <= 60; ++step) {
    ASSERT_TRUE(run_until(simulation, step * settings.time_step));
    if (step <= 10) continue;
    EXPECT_LE(simulation.report().iterations, 3) << step;
  }
  EXPECT_TRUE(simulation.rejections().empty());
}

// 410 bricks that are placed without stress bounce: a sound wave changes the states of most joints in each step. Newton's
// method alone takes 59 iterations and a fallback in the fifth step (notes/hard_steps.md).
TEST(OpenClose, AWallThatBouncesIsSplitInHardSteps) {
  constexpr int courses = 20;
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-90, -90, -5}, {90, 90, 0}));
  for (int row = 0; row < courses; ++row) {
    const double shift = 0.5 * (row % 2);
    for (int k = 0; k < courses + row % 2; ++k) {
      const double left = std::max(0.0, k - shift), right = std::min<double>(courses, k + 1 - shift);
      blocks.emplace_back(
          block_of("brick", Polyhedron(make_box({left, -0.25, 0.5 * row}, {right, 0.25, 0.5 * row + 0.5})),
                   {2600, 1e10, 0.2}, 1));
    }
  }
  SimulationSettings settings;
  settings.time_step = 1.0 / 240.0;
  std::vector<InitialMotion> at_rest(blocks.size());
  Simulation simulation(std::move(blocks), at_rest, same_law({4e11, 4e11, 0.5, 0.0, 0.0, true}), settings);
  for (int step = 1; step <= 6; ++step) {
    ASSERT_TRUE(run_until(simulation, step * settings.time_step));
    EXPECT_LE(simulation.report().iterations, 20) << step;
  }
  EXPECT_EQ(simulation.counts().open_close_fallbacks, 0U);
  EXPECT_TRUE(simulation.rejections().empty());
}

// Corners that are rounded once leave neighbours 1e-15 m in each other or apart: forces that are nothing for a block,
// but more than slivers weigh.
TEST(OpenClose, PiecesOfACutBlockFallTogether) {
  CutSolid cube(Polyhedron(make_box({0, 0, 0}, {10, 10, 10})));
  int mark = 0;
  for (const auto& [dip, direction] :
       {std::pair(35.0, 40.0), std::pair(65.0, 160.0), std::pair(80.0, 290.0)}) {
    for (int k = -4; k <= 4; ++k)
      cube.cut({plane_normal(dip, direction), {5.1, 4.7, 5.3}, 1.7 * k}, mark, [](int) { return true; });
    ++mark;
  }
  std::vector<BlockModel> blocks;
  for (const int piece : cube.pieces())
    blocks.emplace_back(block_of("piece", Polyhedron(cube.mesh(piece)), {2700, 1e10, 0.2}, 0));
  ASSERT_GT(blocks.size(), 200U);
  std::vector<Vector3> centers;
  for (const BlockModel& block : blocks) centers.push_back(block.basis().centroid());
  SimulationSettings settings;
  settings.time_step = 1e-4;
  std::vector<InitialMotion> at_rest(blocks.size());
  Simulation simulation(std::move(blocks), at_rest, same_law({5e10, 2e10, 0.7, 0.0, 0.0, true}), settings);
  ASSERT_EQ(simulation.step(1.0), StepStatus::accepted);
  EXPECT_EQ(simulation.counts().open_close_iterations, 1U);
  for (std::size_t k = 0; k < centers.size(); ++k) {
    const double fall = centers[k].z() - place_of(simulation, static_cast<int>(k), centers[k]).z();
    EXPECT_NEAR(fall, 0.5 * 9.81 * 1e-8, 1e-14) << k;
  }
}

// Four courses of four bricks; the end of the top one overhangs by half its length and topples. As soon as it is fast,
// it lacks more than it does in free fall if all stay, and the fifteen others would lose their states for its sake.
TEST(OpenClose, WhatOneBrickLacksDoesNotMakeTheOthersFall) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-9, -9, -5}, {9, 9, 0}));
  for (int row = 0; row < 4; ++row) {
    for (int k = 0; k < 4; ++k) {
      const Vector3 low(k + 0.5 * (row % 2) - 0.5, -0.25, 0.5 * row);
      blocks.emplace_back(
          block_of("brick", Polyhedron(make_box(low, low + Vector3(1.0, 0.5, 0.5))), {2600, 1e10, 0.2}, 1));
    }
  }
  SimulationSettings settings;
  settings.time_step = 1.0 / 240.0;
  std::vector<InitialMotion> at_rest(blocks.size());
  Simulation simulation(std::move(blocks), at_rest, same_law({2e12, 1e12, 0.5, 0.0, 0.0, true}), settings);
  int iterations = 0;
  for (int step = 1; step <= 260; ++step) {
    ASSERT_TRUE(run_until(simulation, step * settings.time_step));
    if (step > 236) iterations += simulation.report().iterations;
  }
  EXPECT_LT(place_of(simulation, 16, {4.0, 0.0, 1.75}).z(), 1.7) << "it topples";
  EXPECT_LE(iterations, 24 * 6);
}

}  // namespace
}  // namespace ashlar::open_close_test
