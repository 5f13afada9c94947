// Static analyses without equilibrium: moving blocks and their onset.
#include "solver/statics/static_verdict.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/step/accept/snapshot.hpp"
#include "support/simulations.hpp"
#include "unit/solver/statics/sample_statics.hpp"

namespace ashlar::static_verdict_test {
namespace {

using test_support::block_of;
using test_support::fixed_block;
using test_support::fixed_box;
using test_support::models;
using test_support::on_incline;
using test_support::rock;
using test_support::run_static;
using test_support::same_law;
using test_support::tilted_box;

TEST(StaticAnalysis, BlockSlidesOnAnIncline) {
  for (const double friction_angle : {0.0, 20.0, 29.0}) {
    Simulation simulation = on_incline(30, friction_angle);
    ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::moving);
    const auto moving = simulation.moving_blocks();
    ASSERT_EQ(moving.size(), 1U);
    EXPECT_EQ(moving[0].block, 0);
    // a = g (sin 30 - cos 30 tan phi) down the slope, which goes down towards -x
    const double degree = std::numbers::pi / 180.0;
    const double size = 9.81 * (0.5 - std::cos(30 * degree) * std::tan(friction_angle * degree));
    const Vector3 expected = size * Vector3(-std::cos(30 * degree), 0, -0.5);
    EXPECT_LT((moving[0].acceleration - expected).norm(), 1e-3 * size) << moving[0].acceleration.transpose();
    EXPECT_EQ(simulation.static_step(1.0), StaticStatus::moving);
  }
}

TEST(StaticAnalysis, AccelerationsOfABlockThatWasInBalanceAreThoseAfterIt) {
  // Friction holds the block until an iteration has no residual; then there is less of it.
  Simulation held = on_incline(30, 31);
  while (held.snapshot().run.statics.still_iterations == 0)
    ASSERT_EQ(held.static_step(1.0), StaticStatus::balancing);
  Simulation released = on_incline(30, 20);
  released.restore(held.snapshot());
  ASSERT_EQ(run_static(released, 1.0), StaticStatus::moving);
  ASSERT_EQ(released.moving_blocks().size(), 1U);
  const double degree = std::numbers::pi / 180.0;
  const double size = 9.81 * (0.5 - std::cos(30 * degree) * std::tan(20 * degree));
  EXPECT_NEAR(released.moving_blocks()[0].acceleration.norm(), size, 1e-3 * size);
}

TEST(StaticAnalysis, SlowSlidingIsMovingToo) {
  // Just below the limit of friction, a block of high order covers a hundredth of its size in an iteration.
  Simulation simulation = on_incline(10, 9.95, 3);
  ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::moving);
  const double degree = std::numbers::pi / 180.0;
  const double size = 9.81 * (std::sin(10 * degree) - std::cos(10 * degree) * std::tan(9.95 * degree));
  ASSERT_EQ(simulation.moving_blocks().size(), 1U);
  EXPECT_NEAR(simulation.moving_blocks()[0].acceleration.norm() / size, 1.0, 1e-2);
}

/// Angular acceleration about y of a block of base 1 and height 3 on an incline of 30 degrees: the weight
/// acts outside the base, as tan 30 > 1/3.
double toppling(double stiffness) {
  const JointLaw law{stiffness, stiffness, std::tan(50 * std::numbers::pi / 180.0), 0.0, 0.0, true};
  Simulation simulation(models(block_of("A", tilted_box({-0.5, -0.5, 0}, {0.5, 0.5, 3}, 30), rock, 1),
                               fixed_block(tilted_box({-6, -2, -1}, {2, 2, 0}, 30))),
                        {{}, {}}, same_law(law), {});
  EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::moving);
  const std::vector<MovingBlock> moving = simulation.moving_blocks();
  EXPECT_EQ(moving.size(), 1U);
  return moving.empty() ? 0.0 : moving[0].angular_acceleration.y();
}

TEST(StaticAnalysis, TallBlockTopples) {
  // It turns over its lower edge, from +z towards -x, about -y, as it starts to: m g (H/2 sin - D/2 cos) over
  // m (D^2 + H^2)/3, if the joint is so stiff that pressure acts on an edge. Else N = 67 kN press a strip
  // of width w = sqrt(2 N / (k theta)), and it turns over a line w/3 farther in, faster by w/3 of the
  // weight's arm of 0.317 m: at theta = 6e-4 by 5 % with 1e11 Pa/m, by 0.5 % with 1e13.
  const double expected = 9.81 * (1.5 * 0.5 - 0.5 * std::sqrt(0.75)) / (10.0 / 3.0);
  const auto excess = [&](double stiffness) { return toppling(stiffness) / -expected - 1.0; };
  const double soft = excess(1e11);
  const double stiff = excess(1e13);
  const double stiffest = excess(1e15);
  EXPECT_LT(soft, 0.05);
  EXPECT_LT(stiff, 0.01);
  EXPECT_LT(stiffest, 0.002);
  EXPECT_GT(soft, stiff);
  EXPECT_GT(stiff, stiffest);
  EXPECT_GT(stiffest, 0.0);
}

/// A wall of 0.5 x 3 x 2 m and 2000 kg/m3 that is pushed at half its height. @param push N
StaticStatus pushed_wall(double push, int order) {
  BlockDefinition wall =
      block_of("wall", Polyhedron(make_box({0, -1.5, 0}, {0.5, 1.5, 2})), {2000, 1e11, 0.2}, order);
  wall.loads.push_back({Plane{{0, 0, 0}, {-1, 0, 0}}, false, {push, 0, 0}, {}});
  Simulation simulation(models(std::move(wall), fixed_block(Polyhedron(make_box({-3, -3, -1}, {3, 3, 0})))),
                        {{}, {}},
                        same_law({1e9, 1e9, std::tan(40 * std::numbers::pi / 180.0), 0.0, 0.0, true}), {});
  return run_static(simulation, 1.0);
}

// A joint without tension under a rigid wall of weight N: turned by t it is pressed over c, N = kn t c^2 w/2,
// and F h = N (b/2 - c/3 - t h) with h = 1 m. The largest F is at t^(3/2) = sqrt(2 N/(kn w))/6 = 1.044e-3:
// t = 0.01029, c = 0.0617 m, F = 12.90 kN; with all of N on the edge it would be 14.7 kN.
TEST(StaticAnalysis, AWallTurnsOverWhereItsJointIsPressed) {
  for (const int order : {1, 2, 3}) {
    EXPECT_EQ(pushed_wall(12800.0, order), StaticStatus::equilibrium) << order;
    EXPECT_EQ(pushed_wall(13000.0, order), StaticStatus::moving) << order;
  }
}

/// A prism over a profile in x and z, y from 0 to 1.
Polyhedron upright_prism(const std::vector<std::array<double, 2>>& profile) {
  std::vector<Vector3> points;
  for (const auto& [x, z] : profile) points.insert(points.end(), {Vector3(x, 0, z), Vector3(x, 1, z)});
  return Polyhedron(make_convex_hull(points));
}

TEST(StaticAnalysis, PlanksThatSlideApartAreNotFollowedInSmallSteps) {
  // Edges that slide down on each other are detected again in each iteration, which took 500 of them.
  const double friction = std::tan(10.0 * std::numbers::pi / 180.0);
  Simulation simulation(
      models(block_of("left", upright_prism({{-2, 0}, {-1.8, 0}, {0, 1.6}, {0, 1.8}}), rock, 1),
             block_of("right", upright_prism({{2, 0}, {1.8, 0}, {0, 1.6}, {0, 1.8}}), rock, 1),
             fixed_box({-6, -2, -1}, {6, 2, 0})),
      {{}, {}, {}}, same_law({2e11, 1e11, friction, 0.0, 0.0, true}), {});
  ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::moving);
  EXPECT_LE(simulation.steps(), 100);
  const std::vector<MovingBlock> moving = simulation.moving_blocks();
  ASSERT_EQ(moving.size(), 2U);
  EXPECT_LT(moving[0].acceleration.x(), -0.1);
  EXPECT_NEAR(moving[0].acceleration.x(), -moving[1].acceleration.x(), 1e-3);
  EXPECT_NEAR(moving[0].acceleration.z(), moving[1].acceleration.z(), 1e-3);
}

TEST(StaticAnalysis, PlanksThatSlideApartAsTheyFallAreMovingThoughTheyMeetOnEdges) {
  // Two planks lean on each other. They turn flatter about their inner lower and upper corners at f and a
  // from their centroids; these slide on the floor with friction m and stay on the mirror plane:
  //   w (I + za^2 - xf (m (zf - za) - xf)) = g (m (zf - za) - xf),   I the unit inertia.
  // When they have fallen far only two edges meet, and iterations do not go on.
  const std::array<Eigen::Vector2d, 4> corners = {Eigen::Vector2d{-1, 0}, {-0.85, 0}, {0, 1}, {0, 1.25}};
  double area = 0.0;
  double squares = 0.0;
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector2d& p = corners[k];
    const Eigen::Vector2d& q = corners[(k + 1) % 4];
    const double twice = p.x() * q.y() - p.y() * q.x();
    area += twice / 2.0;
    centroid += twice / 6.0 * (p + q);
    squares += twice / 12.0 * (p.dot(p) + p.dot(q) + q.dot(q));
  }
  centroid /= area;
  const Eigen::Vector2d foot = corners[1] - centroid;
  const Eigen::Vector2d top = corners[3] - centroid;
  const double friction = std::tan(12.0 * std::numbers::pi / 180.0);
  const double lever = friction * (foot.y() - top.y()) - foot.x();
  const double turn =
      9.81 * lever / (squares / area - centroid.squaredNorm() + top.y() * top.y() - foot.x() * lever);
  std::vector<BlockDefinition> planks;
  for (const double side : {1.0, -1.0}) {
    std::vector<Vector3> points;
    for (const Eigen::Vector2d& corner : corners)
      for (const double y : {-0.4, 0.4}) points.emplace_back(side * corner.x(), y, corner.y());
    planks.push_back(block_of("plank", Polyhedron(make_convex_hull(points)), {2500, 1e10, 0.2}, 1));
  }
  SimulationSettings settings;
  settings.augmented = true;
  settings.contact_distance = 1e-4;
  settings.multipliers.penetration_tolerance = 1e-7;
  Simulation simulation(
      models(planks[0], planks[1], fixed_block(Polyhedron(make_box({-5, -0.6, -1}, {5, 0.6, 0})))),
      {{}, {}, {}}, same_law({2e11, 1e11, friction, 0.0, 0.0, true}), settings);
  ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::moving);
  const std::vector<MovingBlock> moving = simulation.moving_blocks();
  ASSERT_EQ(moving.size(), 2U);
  for (const std::size_t k : {0U, 1U}) {
    const double side = k == 0 ? 1.0 : -1.0;
    EXPECT_NEAR(moving[k].angular_acceleration.y(), side * turn, 1e-3 * turn);
    EXPECT_NEAR(moving[k].acceleration.x(), -side * turn * top.y(), 1e-3 * turn);
    EXPECT_NEAR(moving[k].acceleration.z(), turn * foot.x(), 1e-3 * turn);
  }
}

TEST(StaticAnalysis, WhatMovesLittleIsNamedToo) {
  // A slender wedge sinks between two blocks that it drives apart by a twentieth of its way: frictionless,
  // (m + 2 M tan^2) a = m g with the masses m of the wedge and M of each of the two.
  const double tangent = 0.05;
  const Polyhedron wedge = upright_prism({{0, 1}, {tangent, 2}, {-tangent, 2}});
  const Polyhedron left = upright_prism({{-1, 0}, {0, 0}, {0, 1}, {-tangent, 2}, {-1, 2}});
  const Polyhedron right = upright_prism({{0, 0}, {1, 0}, {1, 2}, {tangent, 2}, {0, 1}});
  Simulation simulation(models(block_of("wedge", wedge, rock, 1), block_of("left", left, rock, 1),
                               block_of("right", right, rock, 1), fixed_box({-4, -2, -1}, {4, 2, 0})),
                        {{}, {}, {}, {}}, same_law({1e11, 5e10, 0.0, 0.0, 0.0, true}), {});
  ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::moving);
  const std::vector<MovingBlock> moving = simulation.moving_blocks();
  ASSERT_EQ(moving.size(), 3U);
  const double other = 2.0 - 0.5 * tangent;  // m^2
  const double size = 9.81 * tangent / (tangent + 2.0 * other * tangent * tangent);
  EXPECT_NEAR(moving[0].acceleration.z(), -size, 1e-3 * size);
  EXPECT_NEAR(moving[1].acceleration.x(), -tangent * size, 1e-3 * tangent * size);
  EXPECT_NEAR(moving[2].acceleration.x(), tangent * size, 1e-3 * tangent * size);
}

}  // namespace
}  // namespace ashlar::static_verdict_test
