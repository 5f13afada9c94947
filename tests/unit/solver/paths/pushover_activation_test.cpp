// The multiplier at which pushed blocks begin to move, by hand and beside static analyses.
#include "solver/paths/pushover_activation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>

#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::pushover_activation_test {
namespace {

using namespace test_support;

/// Forces in proportion to mass along x. @param limit m
Pushover pushed(const LimitScene& scene, double limit) {
  const Simulation simulation = scene.build();
  PushoverSearch search;
  search.limit = limit;
  return pushover({simulation.system(), simulation.states(), simulation.histories(), 1.0, 1}, search);
}

/// 12 bricks of 0.4 x 0.2 x 0.2 m in running bond, 1.0 x 0.8 m.
LimitScene wall(double friction) {
  LimitScene scene;
  scene.law = joint(friction);
  for (int course = 0; course < 4; ++course) {
    double low = 0.0;
    for (double high = course % 2 == 0 ? 0.4 : 0.2; low < 1.0 - 1e-9; high = std::min(high + 0.4, 1.0)) {
      scene.add("brick", Polyhedron(make_box({low, 0.0, 0.2 * course}, {high, 0.2, 0.2 * (course + 1)})));
      low = high;
    }
  }
  scene.add_fixed(Polyhedron(make_box({-1, -1, -0.5}, {3, 1, 0})));
  return scene;
}

// The blocks right of the steps from the lower right corner turn about it from 0.60 of their weight on, as moments about it
// show (path_search_test.cpp). Joints that dilate hold up to 0.675, where the curve begins.
TEST(PushoverActivation, AWallRocksBeforeItsJointsWouldHaveToDilate) {
  const Pushover found = pushed(wall(tangent_of(37.7)), 1e-3);
  ASSERT_FALSE(found.places.empty()) << to_string(found.end);
  EXPECT_NEAR(found.places.front().multiplier, 0.675, 0.01);
  EXPECT_FALSE(found.at_limit);
  EXPECT_LE(found.activation, 0.60 * 1.001);
  EXPECT_GE(found.activation, 0.60 * 0.99);
}

TEST(PushoverActivation, OneBlockBeginsAtItsLimit) {
  LimitScene scene;
  scene.law = joint(1.0);
  scene.add("block", Polyhedron(make_box({0, 0, 0}, {0.5, 1, 2})));
  scene.add_fixed(Polyhedron(make_box({-3, -1, -1}, {3, 2, 0})));
  const Pushover found = pushed(scene, 1.0);
  EXPECT_TRUE(found.at_limit);
  EXPECT_NEAR(found.activation, 0.25, 1e-6);
}

TEST(PushoverActivation, AnEndedSearchIsInterrupted) {
  const Simulation simulation = wall(0.7).build();
  PushoverSearch search;
  search.limit = 1e-3;
  search.may_continue = [] { return false; };
  const PlacedScene placed{simulation.system(), simulation.states(), simulation.histories(), 1.0, 1};
  EXPECT_FALSE(pushover_activation(placed, search, 0.5));
  EXPECT_EQ(pushover(placed, search).end, PushoverEnd::interrupted);
}

/// A stack of two or three boxes of random sizes and places.
LimitScene random_stack(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  LimitScene scene;
  scene.law = joint(0.3 + 0.5 * share(random));
  scene.add_fixed(Polyhedron(make_box({-5, -5, -1}, {5, 5, 0})));
  double level = 0.0;
  const int count = 2 + static_cast<int>(2.0 * share(random));
  for (int k = 0; k < count; ++k) {
    const double width = 0.5 + 0.6 * share(random), height = 0.3 + share(random);
    const double left = -0.5 * width + 0.15 * (share(random) - 0.5);
    scene.add("box", Polyhedron(make_box({left, -0.4, level}, {left + width, 0.4, level + height})));
    level += height;
  }
  return scene;
}

/// Least of friction, and of the multipliers at which all boxes above a joint turn about its right end: moments of their
/// weights by area.
double multiplier_by_hand(const LimitScene& scene) {
  double least = scene.law.friction;
  double below = std::numeric_limits<double>::infinity();  // right end of the box below
  for (std::size_t k = 1; k < scene.blocks.size(); ++k) {
    double area = 0.0, area_x = 0.0, area_z = 0.0;
    const Box box = box_of(scene.blocks[k].solid->mesh().points);
    for (std::size_t above = k; above < scene.blocks.size(); ++above) {
      const Box b = box_of(scene.blocks[above].solid->mesh().points);
      const double of_box = (b.high[0] - b.low[0]) * (b.high[2] - b.low[2]);
      area += of_box;
      area_x += of_box * 0.5 * (b.low[0] + b.high[0]);
      area_z += of_box * 0.5 * (b.low[2] + b.high[2]);
    }
    least = std::min(least, (std::min(below, box.high[0]) - area_x / area) / (area_z / area - box.low[2]));
    below = box.high[0];
  }
  return least;
}

TEST(PushoverActivation, OfRandomStacksIsThatOfMomentsAndFriction) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const LimitScene scene = random_stack(seed);
    const double multiplier = multiplier_by_hand(scene);
    const Pushover found = pushed(scene, 1e-2);
    ASSERT_FALSE(found.places.empty()) << seed << ' ' << to_string(found.end);
    EXPECT_NEAR(found.activation, multiplier, 1e-6 * multiplier) << seed;
  }
}

// The same blocks under gravity inclined by a little more than the multiplier.
TEST(PushoverActivation, BeyondItStaticAnalysesMove) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    LimitScene scene = random_stack(seed);
    scene.gravity = {1.01 * pushed(scene, 1e-2).activation * g, 0.0, -g};
    Simulation simulation = scene.build();
    EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::moving) << seed;
  }
}

}  // namespace
}  // namespace ashlar::pushover_activation_test
