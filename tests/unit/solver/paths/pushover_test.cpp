// Pushovers of blocks whose curves are known in closed form.
#include "solver/paths/pushover.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::pushover_test {
namespace {

using test_support::block_of;
using test_support::fixed_block;
using test_support::g;
using test_support::joint;
using test_support::LimitScene;
using test_support::rock;

Pushover pushed(const Simulation& simulation, const PushoverSearch& search) {
  return pushover({simulation.system(), simulation.states(), simulation.histories(), 1.0, 1}, search);
}

PushoverSearch along(const Vector3& direction, double limit) {
  PushoverSearch search;
  search.direction = direction;
  search.limit = limit;
  search.shares = {0.16, 0.4};
  return search;
}

/// A block of width b and height h on the ground.
LimitScene standing(double b, double h, double friction = 1.0) {
  LimitScene scene;
  scene.law = joint(friction);
  scene.add("block", Polyhedron(make_box({0, 0, 0}, {b, 1, h})));
  scene.add_fixed(Polyhedron(make_box({-3, -1, -1}, {b + 3, 2, 0})));
  return scene;
}

/// The multiplier of a body that turns about an edge, from the displacement of its centroid.
/// @param lever horizontal distance of the centroid from the edge at first, m. @param height of it above the edge, m
double rocking_multiplier(double lever, double height, double displacement) {
  const double radius = std::hypot(lever, height), sine = (lever - displacement) / radius;
  return sine / std::sqrt(1.0 - sine * sine);
}

/// @param tolerance relative to the first multiplier
void expect_rocking(const Pushover& found, double lever, double height, double tolerance) {
  EXPECT_EQ(found.end, PushoverEnd::zero) << to_string(found.end);
  ASSERT_GT(found.places.size(), 5U);
  const double first = lever / height;
  EXPECT_NEAR(found.places.front().multiplier, first, tolerance * first);
  EXPECT_EQ(found.places.front().displacement, 0.0);
  for (const PushoverPlace& place : found.places)
    EXPECT_NEAR(place.multiplier, rocking_multiplier(lever, height, place.displacement), tolerance * first)
        << place.displacement;
  ASSERT_TRUE(found.zero);
  EXPECT_NEAR(*found.zero, lever, tolerance * lever);
}

TEST(Pushover, OfABlockFollowsTheTangentOfWhatIsLeftToTurn) {
  const std::vector<std::array<double, 2>> sizes = {{0.5, 2.0}, {0.2, 3.0}, {0.9, 1.0}};
  for (const auto& [b, h] : sizes) {
    SCOPED_TRACE(h);
    const Pushover found = pushed(standing(b, h, 1.5).build(), along({2, 0, 0}, 10.0));
    expect_rocking(found, 0.5 * b, 0.5 * h, 1e-6);
    for (const PushoverPlace& place : found.places) EXPECT_EQ(place.moving, std::vector<int>{0});
    ASSERT_EQ(found.mechanism.size(), 1U);
    EXPECT_NEAR(found.mechanism[0].weight, rock.density * g * b * h, 1e-9 * rock.density * g * b * h);
    EXPECT_NEAR(found.mechanism[0].displacement, 1.0, 1e-9);
    EXPECT_FALSE(found.left_out_strength);
  }
}

TEST(Pushover, HasPlacesAtShares) {
  const Pushover found = pushed(standing(0.5, 2.0).build(), along({1, 0, 0}, 10.0));
  ASSERT_TRUE(found.zero);
  for (const double share : {0.16, 0.4}) {
    const double displacement = share * *found.zero;
    EXPECT_TRUE(std::any_of(found.places.begin(), found.places.end(), [&](const PushoverPlace& place) {
      return std::abs(place.displacement - displacement) < 1e-7 * *found.zero;
    })) << share;
    const auto multiplier = multiplier_at(found, displacement);
    ASSERT_TRUE(multiplier);
    EXPECT_NEAR(*multiplier, rocking_multiplier(0.25, 1.0, displacement), 1e-6 * 0.25);
  }
  EXPECT_FALSE(multiplier_at(found, 1.0));
}

TEST(Pushover, StatesHaveForcesInBalance) {
  const Simulation simulation = standing(0.5, 2.0).build();
  const Pushover found = pushed(simulation, along({1, 0, 0}, 10.0));
  const double weight = rock.density * g;
  ASSERT_GE(found.states.size(), 2U);
  EXPECT_EQ(found.states.front().place, 0);
  EXPECT_EQ(found.states.back().place, static_cast<int>(found.places.size()) - 1);
  for (const PushoverState& state : found.states) {
    ASSERT_EQ(state.contacts.size(), 1U);
    Vector3 on_block = Vector3::Zero();
    for (std::size_t k = 0; k < state.contacts[0].points.size(); ++k) {
      const ContactPoint& point = state.contacts[0].points[k];
      const Eigen::Vector3d& force = state.contacts[0].responses[k].force;
      on_block += force[0] * point.normal + force[1] * point.tangent_1 + force[2] * point.tangent_2;
    }
    const double multiplier = found.places[static_cast<std::size_t>(state.place)].multiplier;
    EXPECT_NEAR(on_block.cwiseAbs().x(), multiplier * weight, 1e-5 * weight);
    EXPECT_NEAR(on_block.cwiseAbs().z(), weight, 1e-5 * weight);
  }
}

TEST(Pushover, OfASlidingBlockEndsAtItsLimitAtTheSameHeight) {
  const Simulation simulation = standing(1.0, 1.0, 0.3).build();
  const Pushover found = pushed(simulation, along({1, 0, 0}, 0.4));
  EXPECT_EQ(found.end, PushoverEnd::reaches_limit);
  EXPECT_FALSE(found.zero);
  for (const PushoverPlace& place : found.places) EXPECT_NEAR(place.multiplier, 0.3, 1e-5);
  EXPECT_NEAR(found.places.back().displacement, 0.4, 1e-6);
  const Vector3 centroid = simulation.blocks()[0].basis().centroid();
  const Vector3 last = PlacedBlock(simulation.blocks()[0], found.states.back().positions[0]).place(centroid);
  EXPECT_NEAR(last.z(), centroid.z(), 1e-4);
  EXPECT_NEAR(last.x(), centroid.x() + 0.4, 1e-6);
}

TEST(Pushover, ShowsTheDisplacementOfItsControl) {
  const double b = 0.5, h = 2.0;
  PushoverSearch search = along({1, 0, 0}, 10.0);
  search.control = PushoverControl{0, {b, 0.5, h}};
  const Pushover found = pushed(standing(b, h).build(), search);
  ASSERT_TRUE(found.zero);
  // The corner above the hinge, turned by atan(b / h).
  EXPECT_NEAR(*found.zero, h * b / std::hypot(b, h), 1e-6);
  ASSERT_EQ(found.mechanism.size(), 1U);
  EXPECT_NEAR(found.mechanism[0].displacement, 0.5, 1e-6) << "of the centroid per that of the corner";
  search.control = PushoverControl{1, {0, 0, -1}};
  EXPECT_EQ(pushed(standing(b, h).build(), search).end, PushoverEnd::control_at_rest);
}

TEST(Pushover, OfGivenLoadsMultipliesThese) {
  const double b = 0.5, h = 2.0, force = 700.0, weight = rock.density * g * b * h;
  LimitScene scene = standing(b, h);
  scene.blocks[0].loads.push_back({Vector3(0.0, 0.5, h), false, {force, 0, 0}, {}});
  PushoverSearch search = along({1, 0, 0}, 10.0);
  search.multiplied = {true, false};
  const Pushover found = pushed(scene.build(), search);
  EXPECT_EQ(found.end, PushoverEnd::zero);
  ASSERT_GT(found.places.size(), 5U);
  EXPECT_NEAR(found.places.front().multiplier * force * h / (weight * 0.5 * b), 1.0, 1e-6);
  ASSERT_TRUE(found.zero);
  EXPECT_NEAR(*found.zero, 0.5 * b, 1e-6);
  // The load stays on its point, which turns about the hinge.
  for (const PushoverPlace& place : found.places) {
    const double radius = 0.5 * std::hypot(b, h);
    const double left = std::asin(std::clamp((0.5 * b - place.displacement) / radius, -1.0, 1.0));
    const double turn = std::atan2(b, h) - left;
    const double height = h * std::cos(turn) + b * std::sin(turn);
    EXPECT_NEAR(place.multiplier * force * height, weight * radius * std::sin(left), 2e-6 * weight * b)
        << place.displacement;
  }
}

/// A wall of two blocks, as in vertical bending: it hinges at its outer edge at the base and at its inner edge between the
/// blocks, and its face slides without friction on the edge of a floor at the height `rest`.
struct Strip {
  double thickness = 0.4, lower = 1.6, upper = 1.2, rest = 2.6;

  [[nodiscard]] Simulation build() const {
    std::vector<BlockModel> models;
    models.emplace_back(block_of("lower", Polyhedron(make_box({0, 0, 0}, {thickness, 1, lower})), rock, 0));
    models.emplace_back(
        block_of("upper", Polyhedron(make_box({0, 0, lower}, {thickness, 1, lower + upper})), rock, 0));
    models.emplace_back(fixed_block(Polyhedron(make_box({-1, -1, -1}, {2, 2, 0}))));
    models.emplace_back(fixed_block(Polyhedron(make_box({thickness, -1, rest}, {2, 2, rest + 2}))));
    SimulationSettings settings;
    settings.gravity = {0, 0, -g};
    settings.contact_distance = 1e-3;
    return Simulation(std::move(models), std::vector<InitialMotion>(4),
                      [](int a, int b) { return joint(std::max(a, b) == 3 ? 0.0 : 1.5); }, settings, {});
  }

  using Plane = Eigen::Vector2d;  // x, z
  struct Centres {
    Plane lower, upper;
  };
  /// Centroids when the lower block has turned by an angle.
  [[nodiscard]] Centres turned(double angle) const {
    const auto rotated = [](double by, const Plane& v) {
      return Plane(std::cos(by) * v.x() + std::sin(by) * v.y(), -std::sin(by) * v.x() + std::cos(by) * v.y());
    };
    const Plane base(thickness, 0.0), edge(thickness, rest);
    const Plane hinge = base + rotated(angle, Plane(-thickness, lower));
    // The face of the upper block, at `thickness` from the hinge, goes through the edge.
    double low = -1.0, high = 1.0;
    while (high - low > 1e-15) {
      const double back = 0.5 * (low + high);
      const Plane normal = rotated(-back, Plane::UnitX());
      (normal.dot(edge - hinge) < thickness ? low : high) = back;
    }
    return {base + rotated(angle, Plane(-0.5 * thickness, 0.5 * lower)),
            hinge + rotated(-low, Plane(0.5 * thickness, 0.5 * upper))};
  }
  [[nodiscard]] double displacement(double angle) const {
    const Centres now = turned(angle), before = turned(0.0);
    return (lower * (now.lower - before.lower).x() + upper * (now.upper - before.upper).x()) /
           (lower + upper);
  }
  /// Virtual work of weights and of forces in proportion to them.
  [[nodiscard]] double multiplier(double angle) const {
    constexpr double step = 1e-6;
    const Centres less = turned(angle - step), more = turned(angle + step);
    const Plane lower_way = more.lower - less.lower, upper_way = more.upper - less.upper;
    return (lower * lower_way.y() + upper * upper_way.y()) / (lower * lower_way.x() + upper * upper_way.x());
  }
  [[nodiscard]] double angle_of(double wanted) const {
    double low = 0.0, high = 0.6;
    while (high - low > 1e-13) {
      const double middle = 0.5 * (low + high);
      (displacement(middle) < wanted ? low : high) = middle;
    }
    return low;
  }

  /// Turn of the lower block at which the floor lets go of the upper one.
  [[nodiscard]] double angle_of_release() const {
    const double both = std::atan(thickness / lower) + std::atan(thickness / upper);
    return both - std::asin((thickness + lower * std::sin(both) - thickness * std::cos(both)) / rest);
  }
};

TEST(Pushover, OfAStripThatBendsFollowsItsMechanism) {
  const Strip strip;
  const Pushover found = pushed(strip.build(), along({1, 0, 0}, 1.0));
  ASSERT_GT(found.places.size(), 10U);
  const double first = strip.multiplier(0.0);
  EXPECT_NEAR(found.places.front().multiplier, first, 1e-3 * first);
  for (const PushoverPlace& place : found.places) {
    EXPECT_NEAR(place.multiplier, strip.multiplier(strip.angle_of(place.displacement)), 1e-3 * first)
        << place.displacement;
    EXPECT_EQ(place.moving, (std::vector<int>{0, 1}));
  }
  // The floor only presses: it lets go where each block is in balance on its own hinge, and the upper one falls back.
  EXPECT_EQ(found.end, PushoverEnd::collapses) << to_string(found.end);
  EXPECT_FALSE(found.zero);
  const double angle = strip.angle_of_release();
  EXPECT_NEAR(found.places.back().displacement, strip.displacement(angle), 1e-3 * strip.displacement(angle));
  EXPECT_NEAR(found.places.back().multiplier, std::tan(std::atan(strip.thickness / strip.lower) - angle),
              1e-3 * first);
}

TEST(Pushover, OfAPortalTurnsItsPostsTogether) {
  // The lintel goes twice as far as the centroids of the posts, and does not turn.
  const double b = 0.4, h = 2.0, depth = 0.5, length = 3.4;
  LimitScene scene;
  scene.law = joint(1.0);
  scene.add("left", Polyhedron(make_box({0, 0, 0}, {b, 1, h})));
  scene.add("right", Polyhedron(make_box({2.6, 0, 0}, {2.6 + b, 1, h})));
  scene.add("lintel", Polyhedron(make_box({-0.2, 0, h}, {-0.2 + length, 1, h + depth})));
  scene.add_fixed(Polyhedron(make_box({-2, -1, -1}, {6, 2, 0})));
  const Pushover found = pushed(scene.build(), along({1, 0, 0}, 2.0));
  EXPECT_EQ(found.end, PushoverEnd::zero) << to_string(found.end);
  const double posts = 2.0 * b * h, lintel = depth * length;
  const double post_share = (posts + lintel) / (posts + 2.0 * lintel);  // of the mean displacement
  ASSERT_GT(found.places.size(), 10U);
  for (const PushoverPlace& place : found.places)
    EXPECT_NEAR(place.multiplier, rocking_multiplier(0.5 * b, 0.5 * h, post_share * place.displacement),
                1e-4 * b / h)
        << place.displacement;
  ASSERT_TRUE(found.zero);
  EXPECT_NEAR(*found.zero * post_share, 0.5 * b, 1e-4 * b);
  ASSERT_EQ(found.mechanism.size(), 3U);
  EXPECT_NEAR(found.mechanism[0].displacement, post_share, 1e-5);
  EXPECT_NEAR(found.mechanism[2].displacement, 2.0 * post_share, 1e-5);
}

/// The corner of two walls, cut off along an inclined plane without friction: it turns about an edge across the diagonal.
/// With friction at its back it would be wedged, in forces in balance at least.
Simulation corner() {
  const auto hull = [](const std::vector<Vector3>& points) {
    return test_support::turned(Polyhedron(make_convex_hull(points)),
                                Eigen::AngleAxisd(0.25 * std::numbers::pi, Vector3::UnitZ()));
  };
  /// Between two outlines (u, z), u along the diagonal, of half widths by point.
  using Row = std::array<double, 3>;  // u, half width, z
  const auto made = [&](const std::vector<Row>& rows) {
    std::vector<Vector3> points;
    for (const auto& [u, half, z] : rows)
      for (const double side : {-half, half}) points.emplace_back(u, side, z);
    return hull(points);
  };
  std::vector<BlockModel> models;
  models.emplace_back(block_of(
      "corner", made({{0.5, 0.2, 0.0}, {0.0, 0.5, 0.0}, {0.5, 0.2, 1.5}, {-0.5, 1.0, 1.5}}), rock, 0));
  models.emplace_back(
      fixed_block(made({{0.0, 2.0, 0.0}, {-0.5, 2.0, 1.5}, {-2.0, 2.0, 1.5}, {-2.0, 2.0, 0.0}})));
  models.emplace_back(
      fixed_block(made({{-2.0, 2.0, 0.0}, {3.0, 2.0, 0.0}, {-2.0, 2.0, -1.0}, {3.0, 2.0, -1.0}})));
  SimulationSettings settings;
  settings.gravity = {0, 0, -g};
  settings.contact_distance = 1e-3;
  return Simulation(std::move(models), std::vector<InitialMotion>(3),
                    [](int a, int b) { return joint(std::max(a, b) == 1 ? 0.0 : 1.5); }, settings, {});
}

TEST(Pushover, OfACornerTurnsItAcrossTheDiagonal) {
  const Simulation simulation = corner();
  const Vector3 diagonal = Vector3(1, 1, 0).normalized();
  const Vector3 centroid = simulation.blocks()[0].basis().centroid();
  const Pushover found = pushed(simulation, along(diagonal, 2.0));
  expect_rocking(found, 0.5 - centroid.dot(diagonal), centroid.z(), 1e-5);
}

TEST(Pushover, TurnsWithTheScene) {
  const Eigen::AngleAxisd turn(0.7, Vector3(1, 2, 3).normalized());
  const Pushover found =
      pushed(standing(0.5, 2.0).turned(turn).build(), along(turn * Vector3::UnitX(), 10.0));
  expect_rocking(found, 0.25, 1.0, 1e-5);
}

TEST(Pushover, OfWhatStandsBetweenWallsMovesNothing) {
  LimitScene scene = standing(0.5, 2.0);
  scene.add_fixed(Polyhedron(make_box({0.5, -1, 0}, {2, 2, 3})));
  const Pushover found = pushed(scene.build(), along({1, 0, 0}, 1.0));
  EXPECT_EQ(found.end, PushoverEnd::immovable);
  EXPECT_TRUE(found.places.empty());
}

TEST(Pushover, OfWhatDoesNotStandIsNone) {
  LimitScene scene;
  scene.law = joint(1.0);
  scene.add("block", Polyhedron(make_box({-2, 0, 0}, {0.5, 1, 1})));
  scene.add_fixed(Polyhedron(make_box({0, -1, -1}, {3, 2, 0})));
  EXPECT_EQ(pushed(scene.build(), along({1, 0, 0}, 1.0)).end, PushoverEnd::not_balanced);
}

TEST(Pushover, DoesNotPassAWall) {
  LimitScene scene = standing(0.5, 2.0);
  scene.add_fixed(Polyhedron(make_box({0.6, -1, 0}, {2, 2, 3})));
  const Pushover found = pushed(scene.build(), along({1, 0, 0}, 1.0));
  EXPECT_NE(found.end, PushoverEnd::zero) << to_string(found.end);
  ASSERT_FALSE(found.places.empty());
  // The top meets the wall after 0.1 m, when the centroid has gone half of that; flush with the wall it has gone 0.1 m.
  EXPECT_GT(found.places.back().displacement, 0.045);
  EXPECT_LT(found.places.back().displacement, 0.101);
}

TEST(Pushover, RefusesWhatItCannotFollow) {
  LimitScene scene = standing(0.5, 2.0);
  EXPECT_THROW((void)pushed(scene.build(), along({0, 0, 0}, 1.0)), std::invalid_argument);
  PushoverSearch loads = along({1, 0, 0}, 1.0);
  loads.multiplied = {true, true};
  EXPECT_THROW((void)pushed(scene.build(), loads), std::invalid_argument) << "it has none";
  scene.gravity = Vector3::Zero();
  EXPECT_THROW((void)pushed(scene.build(), along({1, 0, 0}, 1.0)), std::invalid_argument);
}

TEST(Pushover, IsInterruptedWhereItIs) {
  PushoverSearch search = along({1, 0, 0}, 1.0);
  int steps = 0;
  search.may_continue = [&] { return ++steps < 4; };
  const Pushover found = pushed(standing(0.5, 2.0).build(), search);
  EXPECT_EQ(found.end, PushoverEnd::interrupted);
  EXPECT_EQ(found.places.size(), 4U);
}

TEST(Pushover, IsTheSameTwice) {
  const Strip strip;
  const Pushover one = pushed(strip.build(), along({1, 0, 0}, 1.0));
  const Pushover other = pushed(strip.build(), along({1, 0, 0}, 1.0));
  ASSERT_EQ(one.places.size(), other.places.size());
  for (std::size_t k = 0; k < one.places.size(); ++k) {
    EXPECT_EQ(one.places[k].displacement, other.places[k].displacement);
    EXPECT_EQ(one.places[k].multiplier, other.places[k].multiplier);
  }
}

}  // namespace
}  // namespace ashlar::pushover_test
