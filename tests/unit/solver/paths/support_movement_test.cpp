// Limits of support movements, compared with hinged mechanisms in closed form.
#include "solver/paths/support_movement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "solver/paths/thrust.hpp"
#include "solver/paths/yielding_support.hpp"
#include "unit/solver/statics/sample_limits.hpp"
#include "unit/solver/statics/sample_spread_arch.hpp"

namespace ashlar::support_movement_test {
namespace {

using test_support::g;
using test_support::joint;
using test_support::LimitScene;
using test_support::Point;
using test_support::prism;
using test_support::rock;
using test_support::RoundArch;
using test_support::SpreadArch;
using test_support::Weight;
using test_support::weight_of;

/// The movement of a block of a scene.
SupportMovement moved(const LimitScene& scene, int support, const MovementSearch& search) {
  const Simulation simulation = scene.build();
  return support_movement({simulation.system(), simulation.states(), simulation.histories(), 1.0, 1}, support,
                          search);
}

/// Two blocks side by side between two walls: a flat arch of half span 2 m and depth 0.5 m. Blocks 2 and 3 are walls.
LimitScene flat_arch() {
  LimitScene scene;
  scene.law = joint(1.0);
  scene.add("left", Polyhedron(make_box({-2, 0, 0}, {0, 1, 0.5})));
  scene.add("right", Polyhedron(make_box({0, 0, 0}, {2, 1, 0.5})));
  scene.add_fixed(Polyhedron(make_box({-3, 0, -0.5}, {-2, 1, 1})));
  scene.add_fixed(Polyhedron(make_box({2, 0, -0.5}, {3, 1, 1})));
  return scene;
}

/// The bracket is as narrow as rounding allows, and contains a value, except for the errors of many steps.
void expect_end(const SupportPath& path, double value) {
  constexpr double widest = 2e-5, of_steps = 2e-6;
  EXPECT_EQ(path.end, MovementEnd::collapses);
  ASSERT_TRUE(path.upper);
  EXPECT_LE(*path.upper - path.lower, widest);
  EXPECT_LE(path.lower, value + of_steps);
  EXPECT_GE(*path.upper, value - of_steps);
}

TEST(SupportMovement, OfAFlatArchEndsWhereItsHingesAreInLine) {
  // Hinges at the lower corners at the walls and at the upper one between the blocks: two bars of length D, half the
  // span L + s/2. In line at s = 2 (D - L).
  const double half = 2.0, depth = 0.5, bar = std::hypot(half, depth);
  const double weight = rock.density * g * half * depth;
  for (const int wall : {2, 3}) {
    const SupportPath path = moved(flat_arch(), wall, {std::nullopt, 1.0, 1e-5}).out;
    expect_end(path, 2.0 * (bar - half));
    // The weight of each acts at half the bar: H y = W (L + s/2) / 2.
    ASSERT_GT(path.places.size(), 10U);
    for (const MovedPlace& place : path.places) {
      const double reach = half + 0.5 * place.moved, rise = std::sqrt(bar * bar - reach * reach);
      if (rise < 0.1 * depth) continue;
      EXPECT_NEAR(place.thrust * 2.0 * rise / (weight * reach), 1.0, 2e-4) << place.moved;
    }
    ASSERT_EQ(path.joints.size(), 3U);
    for (const MovedJoint& joint : path.joints) EXPECT_LT(joint.slip, 1e-3);
    EXPECT_EQ(path.moving, (std::vector<int>{0, 1}));
  }
}

/// The last place of a movement up to a limit has the thrust and the forces of that place.
TEST(SupportMovement, EndsWithTheForcesOfItsLimit) {
  const double half = 2.0, depth = 0.5, bar = std::hypot(half, depth),
               weight = rock.density * g * half * depth;
  for (int k = 1; k <= 24; ++k) {
    const double limit = 0.005 * k;
    const SupportPath path = moved(flat_arch(), 2, {std::nullopt, limit, 1e-5}).out;
    EXPECT_EQ(path.end, MovementEnd::reaches_limit) << limit;
    ASSERT_FALSE(path.places.empty());
    EXPECT_NEAR(path.places.back().moved, limit, 1e-9);
    const double reach = half + 0.5 * limit, rise = std::sqrt(bar * bar - reach * reach);
    EXPECT_NEAR(path.places.back().thrust * 2.0 * rise / (weight * reach), 1.0, 1e-3) << limit;
    EXPECT_FALSE(path.contacts.empty()) << limit;
  }
}

TEST(SupportMovement, IsInTheBracketWhateverItsTolerance) {
  const double value = 2.0 * (std::hypot(2.0, 0.5) - 2.0);
  for (const double tolerance : {1e-3, 3e-4, 1e-4, 3e-5, 1e-5}) {
    const SupportPath path = moved(flat_arch(), 2, {std::nullopt, 1.0, tolerance}).out;
    EXPECT_EQ(path.end, MovementEnd::collapses) << tolerance;
    ASSERT_TRUE(path.upper);
    EXPECT_LT(path.lower, value) << tolerance;
    EXPECT_GT(*path.upper, value) << tolerance;
    EXPECT_LE(*path.upper - path.lower, 2.0 * tolerance);
  }
}

TEST(SupportMovement, OfAFlatArchThatIsPressedInJams) {
  const SupportPath path = moved(flat_arch(), 2, {std::nullopt, 1.0, 1e-4}).in;
  EXPECT_EQ(path.end, MovementEnd::jams);
  EXPECT_EQ(path.lower, 0.0);
  ASSERT_TRUE(path.upper);
  EXPECT_LE(*path.upper, 1e-4);
}

/// Two triangles that lean on each other over a joint at the crown and stand on floors: blocks 2 and 3.
LimitScene leaning_bars(double friction) {
  LimitScene scene;
  scene.law = joint(friction);
  scene.add("left", prism({{-1, 0}, {0, 0.6}, {0, 1}}));
  scene.add("right", prism({{1, 0}, {0, 0.6}, {0, 1}}));
  scene.add_fixed(Polyhedron(make_box({-3, 0, -0.5}, {-0.5, 1, 0})));
  scene.add_fixed(Polyhedron(make_box({0.5, 0, -0.5}, {3, 1, 0})));
  return scene;
}

/// Thrust of leaning bars over the weight of one, whose feet have spread by some distance. From foot to
/// crown (cos a, sin a) D; the centre of gravity, (2/3, 1.6/3) from the foot at first, turns with it. H D sin a = W x.
double thrust_of_leaning_bars(double spread) {
  const double bar = std::sqrt(2.0), lead = std::atan2(1.6, 2.0) - 0.25 * std::numbers::pi;
  const double angle = std::acos((1.0 + 0.5 * spread) / bar);
  return std::hypot(2.0 / 3.0, 1.6 / 3.0) * std::cos(angle + lead) / (bar * std::sin(angle));
}
/// At which their feet slide: H = mu W.
double most_spread_of_leaning_bars(double friction) {
  double low = 0.0, high = 0.8;
  while (high - low > 1e-12) {
    const double middle = 0.5 * (low + high);
    (thrust_of_leaning_bars(middle) < friction ? low : high) = middle;
  }
  return low;
}

TEST(SupportMovement, OfLeaningBarsEndsWhereAFootSlides) {
  for (const double friction : {0.8, 1.0}) {
    const SupportPath path = moved(leaning_bars(friction), 2, {std::nullopt, 1.0, 1e-5}).out;
    expect_end(path, most_spread_of_leaning_bars(friction));
    const double weight = rock.density * g * 0.5 * 0.4;
    for (const MovedPlace& place : path.places)
      EXPECT_NEAR(place.thrust / (weight * thrust_of_leaning_bars(place.moved)), 1.0, 1e-4) << place.moved;
  }
}

TEST(SupportMovement, OfASupportAllAroundSpreadsIt) {
  // Both feet stand on the same floor, 1 m from the middle, and move by as much as it spreads.
  LimitScene scene = leaning_bars(0.8);
  scene.blocks.resize(2);
  scene.add_fixed(Polyhedron(make_box({-3, 0, -0.5}, {3, 1, 0})));
  const SupportMovement movement = moved(scene, 2, {std::nullopt, 1.0, 1e-5});
  EXPECT_FALSE(movement.direction);
  expect_end(movement.out, 0.5 * most_spread_of_leaning_bars(0.8));
  // Its load is the push of both.
  const double weight = rock.density * g * 0.5 * 0.4;
  for (const MovedPlace& place : movement.out.places)
    EXPECT_NEAR(place.thrust / (2.0 * weight * thrust_of_leaning_bars(2.0 * place.moved)), 1.0, 1e-4);
  const std::vector<ThrustRange> ranges = thrust_ranges(scene.build().rigid_model(1.0), scene.gravity, 1);
  ASSERT_EQ(ranges.size(), 1U);
  EXPECT_NEAR(ranges[0].least->thrust / (2.0 * weight * thrust_of_leaning_bars(0.0)), 1.0, 1e-5);
}

TEST(SupportMovement, OfARoundArchEndsWhereTheLineOfThrustLeavesTheHaunch) {
  for (const double thickness : {0.15, 0.25}) {
    const RoundArch arch{12, thickness};
    // The joint of the haunch at which the thrust is most is the one whose line stays within the arch.
    int haunch = 7;
    for (int k = 8; k < 12; ++k)
      if (SpreadArch(arch, k, 0.0).thrust() > SpreadArch(arch, haunch, 0.0).thrust()) haunch = k;
    ASSERT_TRUE(SpreadArch(arch, haunch, 0.0).stands());
    double low = 0.0, high = 0.0;
    while (SpreadArch(arch, haunch, high).stands()) high += 0.01;
    low = high - 0.01;
    while (high - low > 1e-9) {
      const double middle = 0.5 * (low + high);
      (SpreadArch(arch, haunch, middle).stands() ? low : high) = middle;
    }
    const SupportPath path = moved(arch.scene(), 13, {std::nullopt, 1.0, 1e-5}).out;
    expect_end(path, low);
    for (const MovedPlace& place : path.places)
      EXPECT_NEAR(place.thrust / SpreadArch(arch, haunch, place.moved).thrust(), 1.0, 1e-5) << place.moved;
    ASSERT_EQ(path.joints.size(), 3U);
    EXPECT_EQ(path.joints.back().blocks, (PairKey{haunch - 1, haunch}));
  }
}

TEST(SupportMovement, OfARoundArchThatIsPressedInLiftsItsCrown) {
  // Hinges at the outer sides of the springings and at the inner one of the crown: half an arch is a bar.
  const RoundArch arch{12, 0.25};
  Weight half;
  for (int k = 6; k < 12; ++k) {
    const Weight weight = weight_of(arch.voussoir(k));
    half.force += weight.force;
    half.place += weight.force * weight.place;
  }
  half.place /= half.force;
  const Point foot = arch.outer(12), crown = arch.inner(6);
  const double bar = (crown - foot).norm();
  const SupportPath path = moved(arch.scene(), 12, {std::nullopt, 0.3, 1e-4}).in;
  EXPECT_EQ(path.end, MovementEnd::reaches_limit);
  EXPECT_DOUBLE_EQ(path.lower, 0.3);
  ASSERT_GT(path.places.size(), 10U);
  for (const MovedPlace& place : path.places) {
    const double reach = foot.x() - 0.5 * place.moved, rise = std::sqrt(bar * bar - reach * reach);
    const Eigen::Rotation2Dd turn(std::atan2(rise, -reach) - std::atan2(crown.y(), crown.x() - foot.x()));
    const double arm = -(turn * (half.place - foot)).x();
    EXPECT_NEAR(place.thrust * rise / (half.force * arm), 1.0, 1e-4) << place.moved;
  }
}

TEST(SupportMovement, SettlingAndLiftingAreMirrorImages) {
  // A settling support has the effect of lifting the other one, and the arch is its own mirror image.
  const SupportMovement movement = moved(RoundArch{12, 0.15}.scene(), 13, {Vector3(0, 0, -2), 1.0, 1e-4});
  EXPECT_EQ(movement.out.end, MovementEnd::collapses);
  EXPECT_EQ(movement.in.end, MovementEnd::collapses);
  EXPECT_GT(movement.out.lower, 0.1);
  EXPECT_NEAR(movement.out.lower, movement.in.lower, 1e-4);
}

TEST(SupportMovement, BeginsAtTheLeastThrust) {
  const LimitScene scene = leaning_bars(1.0);
  const Simulation simulation = scene.build();
  for (const ThrustRange& range : thrust_ranges(simulation.rigid_model(1.0), scene.gravity, 1)) {
    const SupportMovement movement = moved(scene, range.support, {std::nullopt, 0.01, 1e-4});
    ASSERT_TRUE(range.least && !movement.out.places.empty());
    EXPECT_NEAR(movement.out.places.front().thrust / range.least->thrust, 1.0, 1e-5);
  }
}

TEST(SupportMovement, SlidingJointsDoNotRise) {
  // A box on two floors, of which one moves: it slides, and stays as high as it was.
  LimitScene scene;
  scene.law = joint(0.5);
  scene.add("box", Polyhedron(make_box({-2, 0, 0}, {2, 1, 0.5})));
  scene.add_fixed(Polyhedron(make_box({-3, 0, -1}, {-1, 1, 0})));
  scene.add_fixed(Polyhedron(make_box({1, 0, -1}, {3, 1, 0})));
  const SupportPath path = moved(scene, 1, {std::nullopt, 0.3, 1e-4}).out;
  EXPECT_EQ(path.end, MovementEnd::reaches_limit);
  EXPECT_FALSE(path.upper);
  EXPECT_DOUBLE_EQ(path.lower, 0.3);
  double slip = 0.0;
  for (const MovedJoint& joint : path.joints) slip += joint.slip;
  EXPECT_NEAR(slip, 0.3, 1e-3);
  const double weight = rock.density * g * 2.0;
  for (const MovedPlace& place : path.places) EXPECT_LE(std::abs(place.thrust), 0.5 * weight * (1.0 + 1e-5));
  const Simulation simulation = scene.build();
  const Eigen::MatrixX3d change = path.positions[0] - simulation.states()[0].position;
  EXPECT_LT(change.col(2).norm(), 1e-5);
}

TEST(SupportMovement, EndsWhereAnyOrderOfSlipDoes) {
  // A beam falls where it has slid off the shorter of its bearings, if that end slides alone.
  for (const auto& [left, right] : {std::array{0.2, 0.2}, std::array{0.3, 0.2}, std::array{0.15, 0.25}}) {
    LimitScene scene;
    scene.law = joint(0.5);
    scene.add("beam", Polyhedron(make_box({-1.0 - left, 0, 0}, {1.0 + right, 1, 0.4})));
    scene.add_fixed(Polyhedron(make_box({-2, 0, -1}, {-1, 1, 0})));
    scene.add_fixed(Polyhedron(make_box({1, 0, -1}, {2, 1, 0})));
    const SupportPath path = moved(scene, 2, {Vector3(1, 0, 0), 1.0, 1e-4}).out;
    const double shorter = std::min(left, right);
    EXPECT_EQ(path.end, MovementEnd::collapses) << left << " and " << right;
    EXPECT_LE(path.lower, shorter + 1e-6) << left << " and " << right;
    ASSERT_TRUE(path.upper && path.farthest) << left << " and " << right;
    EXPECT_NEAR(*path.upper, shorter, 5e-4) << left << " and " << right;
    EXPECT_LE(*path.farthest, left + right + 1e-3);
    if (left == right) {
      EXPECT_NEAR(*path.farthest, left + right, 1e-3);
    }
  }
  EXPECT_FALSE(moved(flat_arch(), 2, {std::nullopt, 1.0, 1e-4}).out.farthest);
}

TEST(SupportMovement, OfWhatRidesOnTheSupportIsNotLimited) {
  LimitScene scene;
  scene.add("box", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})));
  scene.add_fixed(Polyhedron(make_box({-2, -2, -1}, {3, 3, 0})));
  const SupportMovement movement = moved(scene, 1, {Vector3(2, 0, 0), 0.2, 1e-4});
  ASSERT_TRUE(movement.direction);
  EXPECT_NEAR((*movement.direction - Vector3::UnitX()).norm(), 0.0, 1e-15);
  for (const SupportPath* path : {&movement.out, &movement.in}) {
    EXPECT_EQ(path->end, MovementEnd::reaches_limit);
    EXPECT_DOUBLE_EQ(path->lower, 0.2);
    for (const MovedPlace& place : path->places)
      EXPECT_NEAR(place.thrust / (rock.density * g), 0.0, 1e-6) << place.moved;
    for (const MovedJoint& joint : path->joints) EXPECT_LT(joint.slip, 1e-5);
  }
}

TEST(SupportMovement, WithoutBalanceAtTheStartIsNone) {
  LimitScene scene;
  scene.law = joint(0.1);
  scene.add("left", prism({{-1, 0}, {0, 0.6}, {0, 1}}));
  scene.add("right", prism({{1, 0}, {0, 0.6}, {0, 1}}));
  scene.add_fixed(Polyhedron(make_box({-3, 0, -0.5}, {3, 1, 0})));
  const SupportMovement movement = moved(scene, 2, {Vector3(1, 0, 0), 0.2, 1e-4});
  for (const SupportPath* path : {&movement.out, &movement.in}) {
    EXPECT_EQ(path->end, MovementEnd::not_balanced);
    EXPECT_EQ(path->lower, 0.0);
    EXPECT_FALSE(path->upper);
    EXPECT_TRUE(path->places.empty());
  }
}

TEST(SupportMovement, RefusesWhatItCannotFollow) {
  LimitScene scene = flat_arch();
  scene.gravity = Vector3::Zero();
  EXPECT_THROW((void)moved(scene, 2, {std::nullopt, 1.0, 1e-4}), std::invalid_argument);
  scene = flat_arch();
  scene.add_fixed(Polyhedron(make_box({10, 0, 0}, {11, 1, 1})));
  EXPECT_THROW((void)moved(scene, 4, {std::nullopt, 1.0, 1e-4}), std::invalid_argument);
}

TEST(SupportMovement, EndsAtAnEquilibrium) {
  // Limit analysis of the blocks where they are at the end, points within 0.01 mm, finds forces in balance.
  LimitScene scene = RoundArch{12, 0.15}.scene();
  scene.contact_distance = 1e-5;
  const SupportPath path = moved(scene, 13, {std::nullopt, 1.0, 1e-4}).out;
  const Simulation simulation = scene.build();
  RunState state;
  state.states = simulation.states();
  for (std::size_t k = 0; k < state.states.size(); ++k) state.states[k].position = path.positions[k];
  LimitAnalysis analysis(
      rigid_model(simulation.system(), state, 1.0, {}), [](int, int) { return false; }, 1);
  EXPECT_EQ(analysis.associated({}).outcome, LimitOutcome::stands);
}

TEST(SupportMovement, TurnsAndScalesWithTheScene) {
  const MovementSearch search{std::nullopt, 1.0, 1e-4};
  const double once = moved(flat_arch(), 2, search).out.lower;
  const LimitScene turned = flat_arch().turned(Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()));
  EXPECT_NEAR(moved(turned, 2, search).out.lower, once, 1e-4);
  EXPECT_NEAR(moved(flat_arch().scaled(1e3), 2, {std::nullopt, 1e3, 0.1}).out.lower, 1e3 * once, 0.1);
}

TEST(SupportMovement, IsTheSameTwice) {
  const MovementSearch search{std::nullopt, 1.0, 1e-3};
  const SupportPath once = moved(flat_arch(), 2, search).out, again = moved(flat_arch(), 2, search).out;
  EXPECT_EQ(once.lower, again.lower);
  ASSERT_EQ(once.positions.size(), again.positions.size());
  for (std::size_t k = 0; k < once.positions.size(); ++k) EXPECT_EQ(once.positions[k], again.positions[k]);
}

}  // namespace
}  // namespace ashlar::support_movement_test
