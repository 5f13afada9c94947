// Blocks that slide from one block to the next over a joint.
#include "solver/contact/internal_edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/placed_bodies.hpp"
#include "support/simulations.hpp"

namespace ashlar::internal_edges_test {
namespace {

using test_support::block_of;
using test_support::place_of;
using test_support::run_until;
using test_support::same_law;
using test_support::turned;

struct Crossing {
  int order = 1;
  bool area = true;
  double friction = 0.0;
  int strips = 5;
  double degrees = 0.0;  ///< of the floor's slope
};

/// A block slides for 0.4 s at 3 m/s over strips with flush tops. @return its simulation
Simulation crossed(const Crossing& crossing, Polyhedron block) {
  std::vector<BlockModel> blocks;
  std::vector<InitialMotion> motions;
  const double length = 4.0 / crossing.strips;
  for (int k = 0; k < crossing.strips; ++k) {
    BlockDefinition strip = block_of(
        "strip",
        test_support::tilted_box({-1 + k * length, -1, -1}, {-1 + (k + 1) * length, 1, 0}, crossing.degrees),
        {2500, 1e9, 0.2}, 1);
    strip.fixed = true;
    blocks.emplace_back(std::move(strip));
    motions.emplace_back();
  }
  blocks.emplace_back(block_of("block", std::move(block), {2500, 1e10, 0.2}, crossing.order));
  InitialMotion sliding;
  const double angle = crossing.degrees * std::numbers::pi / 180.0;
  sliding.velocity = 3.0 * Vector3(std::cos(angle), 0.0, std::sin(angle));
  motions.push_back(sliding);
  SimulationSettings settings;
  settings.time_step = 1e-3;
  settings.area_springs = crossing.area;
  const double stiffness = crossing.area ? 1e9 : 2.5e8;
  Simulation simulation(std::move(blocks), std::move(motions),
                        same_law({stiffness, stiffness, crossing.friction, 0.0, 0.0, crossing.area}),
                        settings);
  EXPECT_TRUE(run_until(simulation, 0.4));
  return simulation;
}

/// A cube.
Simulation crossed(const Crossing& crossing) {
  return crossed(crossing, test_support::tilted_box({-0.5, -0.5, 0}, {0.5, 0.5, 1}, crossing.degrees));
}

Vector3 travel(const Simulation& simulation) {
  const int cube = static_cast<int>(simulation.blocks().size()) - 1;
  const Vector3 start = simulation.blocks().back().basis().centroid();
  return place_of(simulation, cube, start) - start;
}

TEST(InternalEdges, ACubeSlidesOverThemAsOverOneFloor) {
  for (const int order : {1, 2}) {
    for (const bool area : {true, false}) {
      Crossing crossing;
      crossing.order = order;
      crossing.area = area;
      const Vector3 moved = travel(crossed(crossing));
      EXPECT_NEAR(moved.x(), 1.2, area ? 1e-8 : 1e-4) << order << area;
      // It rests 2.45e-5 m deep and does not sink at a joint, as it would by as much again if springs began
      // anew there.
      if (area && order == 1) {
        EXPECT_NEAR(moved.z(), -2500.0 * 9.81 / 1e9, 2e-6);
      }
      EXPECT_NEAR(moved.z(), 0.0, 1e-4) << order << area;
    }
  }
}

TEST(InternalEdges, FrictionGoesOnOverThem) {
  // 3 t - mu g t^2 / 2 = 1.2 - 0.2 * 9.81 * 0.08
  Crossing crossing;
  crossing.friction = 0.2;
  EXPECT_NEAR(travel(crossed(crossing)).x(), 1.2 - 0.2 * 9.81 * 0.08, 1e-3);
}

TEST(InternalEdges, OnASlopeToo) {
  // Against gravity's share along the slope.
  Crossing crossing;
  crossing.degrees = 10.0;
  const double angle = 10.0 * std::numbers::pi / 180.0;
  const double expected = 1.2 - 0.5 * 9.81 * std::sin(angle) * 0.16;
  EXPECT_NEAR(travel(crossed(crossing)).norm(), expected, 2e-3);
}

TEST(InternalEdges, StonesWithSidesThatLeanOutSlideOverThem) {
  // The edges of strips are under such sides before the sole reaches them.
  for (const int order : {1, 2}) {
    for (const bool area : {true, false}) {
      Crossing crossing;
      crossing.order = order;
      crossing.area = area;
      for (const double overhang : {0.05, 0.2, 0.35}) {
        std::vector<Vector3> points;
        for (const double y : {-0.3, 0.3}) {
          for (const double side : {-1.0, 1.0}) {
            points.emplace_back(0.4 * side, y, 0.0);
            points.emplace_back((0.4 + overhang) * side, y, 0.2);
          }
        }
        const Vector3 moved = travel(crossed(crossing, Polyhedron(make_convex_hull(points))));
        EXPECT_NEAR(moved.x(), 1.2, 1e-3) << order << area << overhang;
        EXPECT_NEAR(moved.z(), 0.0, 1e-4) << order << area << overhang;
      }
      // A corner ahead, between two edges that rise.
      const std::vector<Vector3> corner_ahead = {{0.5, 0, 0},      {-0.4, 0.4, 0},   {-0.4, -0.4, 0},
                                                 {0.9, 0.8, 0.5},  {0.9, -0.8, 0.5}, {-0.6, 0.8, 0.5},
                                                 {-0.6, -0.8, 0.5}};
      const Vector3 moved = travel(crossed(crossing, Polyhedron(make_convex_hull(corner_ahead))));
      EXPECT_NEAR(moved.x(), 1.2, 1e-3) << order << area;
      EXPECT_NEAR(moved.z(), 0.0, 1e-4) << order << area;
    }
  }
}

/// A stone and a floor of two blocks whose tops are flush at z = 0 and meet at x = joint.
struct OverJoint {
  double joint = 0.3;
  Vector3 velocity{2, 0, 0};
  double end_time = 0.03;
  double modulus = 1e10;
  double stiffness = 1e10;
  bool augmented = false;
  bool loose = false;  ///< the floor lies on a fixed block
  bool area = true;    ///< springs
};

Simulation over_joint(const OverJoint& scene, Polyhedron stone) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(test_support::fixed_box({-3, -2, -1}, {4, 2, -0.5}));
  for (const double side : {-1.5, 1.5}) {
    const Vector3 low(std::min(scene.joint + side, scene.joint), -1, -0.5);
    BlockDefinition slab =
        block_of("slab", test_support::box(low, low + Vector3(1.5, 2, 0.5)), {2500, scene.modulus, 0.2}, 1);
    slab.fixed = !scene.loose;
    blocks.emplace_back(std::move(slab));
  }
  blocks.emplace_back(block_of("stone", std::move(stone), {2500, scene.modulus, 0.2}, 1));
  SimulationSettings settings;
  settings.time_step = scene.loose ? 1e-3 : 5e-4;
  settings.augmented = scene.augmented;
  std::vector<InitialMotion> motions(4);
  motions[3].velocity = scene.velocity;
  Simulation simulation(
      std::move(blocks), motions,
      [&](int a, int) {
        const double friction = a == 0 ? 0.7 : 0.0;
        return JointLaw{scene.stiffness, scene.stiffness, friction, 0.0, 0.0, scene.area};
      },
      settings);
  EXPECT_TRUE(run_until(simulation, scene.end_time));
  return simulation;
}

Vector3 velocity_of_stone(const Simulation& simulation) {
  return simulation.blocks()[3].momentum(simulation.states()[3]) / simulation.blocks()[3].mass();
}

TEST(InternalEdges, StonesMayStartOnThem) {
  const Polyhedron stone = test_support::box({-0.3, -0.3, 0}, {0.3, 0.3, 0.2});
  std::vector<Vector3> knife;
  for (const double y : {-0.3, 0.3}) {
    knife.emplace_back(0.3, y, 0.0);
    for (const double x : {0.0, 0.6}) knife.emplace_back(x, y, 0.3);
  }
  // An edge that ends a step so little past the joint has barely reached the next block.
  for (const double past : {0.0, 1e-12, 1e-9}) {
    OverJoint scene;
    scene.joint = 0.3 - past;
    EXPECT_NEAR(velocity_of_stone(over_joint(scene, stone)).x(), 2.0, 1e-6) << past;
    EXPECT_NEAR(velocity_of_stone(over_joint(scene, Polyhedron(make_convex_hull(knife)))).x(), 2.0, 1e-6)
        << past;
  }
}

TEST(InternalEdges, StonesMayLandOnThem) {
  // Its sides lean out, and come over the edge of the block ahead before it has landed, 0.02 m to the right.
  std::vector<Vector3> points;
  for (const double y : {-0.3, 0.3}) {
    for (const double side : {-1.0, 1.0}) {
      points.emplace_back(0.3 * side, y, 0.01);
      points.emplace_back(0.5 * side, y, 0.31);
    }
  }
  for (const double joint : {0.3185, 0.319, 0.3195, 0.32}) {
    OverJoint scene;
    scene.joint = joint;
    scene.velocity = {2, 0, -1};
    const Vector3 velocity = velocity_of_stone(over_joint(scene, Polyhedron(make_convex_hull(points))));
    EXPECT_NEAR(velocity.x(), 2.0, 1e-6) << joint;
  }
}

/// A stone slides at 2 m/s from one loose slab to the next.
double speed_over_loose_slabs(OverJoint scene, double height, double modulus, double stiffness_per_modulus) {
  scene.joint = 0.5;
  scene.loose = true;
  scene.modulus = modulus;
  scene.stiffness = stiffness_per_modulus * modulus;
  return velocity_of_stone(over_joint(scene, test_support::box({-0.3, -0.3, 0}, {0.3, 0.3, height}))).x();
}

TEST(InternalEdges, LooseBlocksMakeThemToo) {
  // The slab under the stone lies deeper in its support than the next one.
  for (const bool augmented : {false, true}) {
    OverJoint scene;
    scene.end_time = 0.4;
    scene.augmented = augmented;
    for (const double modulus : {1e11, 1e13})
      EXPECT_NEAR(speed_over_loose_slabs(scene, 0.2, modulus, 100.0), 2.0, 1e-6) << augmented << modulus;
  }
}

TEST(InternalEdges, BlocksThatAreSofterThanTheirSpringsMakeThemToo) {
  // The slab under the stone is compressed to less than the height of the next, by far more than
  // contacts are deep.
  for (const bool augmented : {false, true}) {
    OverJoint scene;
    scene.end_time = 0.5;
    scene.augmented = augmented;
    scene.area = augmented;
    for (const double modulus : {1e8, 1e9})
      EXPECT_NEAR(speed_over_loose_slabs(scene, 0.4, modulus, 20.0), 2.0, 1e-3) << augmented << modulus;
  }
}

/// The remaining contacts between two blocks after a retraction from a third.
PairContacts left_by(const Vector3& direction, const test_support::PlacedBody& a,
                     const test_support::PlacedBody& b) {
  PairContacts contacts = find_contacts(a.placed, b.placed, {1e-3, 1e-3, 1e-4});
  remove_internal_edges(
      a.placed, b.placed, {{direction, 1e-2, {0, 2}, false}}, [](const Retraction&) { return true; },
      contacts);
  return contacts;
}

TEST(InternalEdges, BlocksOfOneHeightPush) {
  // Two boxes whose upper rims cross, or of which one has a corner in a side of the other. Where they lie on
  // or under another block, they have a retraction up or down from it.
  const test_support::PlacedBody first(test_support::tilted_box({-1, 0, -1}, {0, 1, 0}, -0.5));
  const test_support::PlacedBody second(turned(test_support::tilted_box({0, 0, -1}, {1, 1, 0}, 0.5),
                                               Eigen::AngleAxisd(1e-3, Vector3::UnitX()), {0, 0.5, 0}));
  const Polyhedron cube = test_support::box({-1, 0, -1}, {0, 1, 0});
  const test_support::PlacedBody corner(
      turned(cube, Eigen::AngleAxisd(std::numbers::pi / 4.0, Vector3::UnitZ()), {-0.5, 0.5, 0}));
  const double ahead = std::sqrt(0.5) - 0.5;
  const test_support::PlacedBody next(test_support::box({ahead, -2, -1}, {1, 2, 0}));
  for (const Vector3& direction : {Vector3(0, 0, 1), Vector3(0, 0, -1)}) {
    EXPECT_FALSE(left_by(direction, first, second).edges.empty()) << direction.z();
    EXPECT_EQ(left_by(direction, corner, next).vertices.size(), 2U) << direction.z();
  }
}

/// Depth within 0.3 s of a block placed on a fixed one, its mirror image below z = 0, m.
/// @param corners of the upper block, its lowest point at 0
double deepest_on_mirror_image(const std::vector<Vector3>& corners, int order, double stiffness) {
  std::vector<BlockModel> blocks;
  for (const double up : {-1.0, 1.0}) {
    std::vector<Vector3> points;
    for (const Vector3& corner : corners) points.emplace_back(corner.x(), corner.y(), up * corner.z());
    BlockDefinition block =
        block_of("block", Polyhedron(make_convex_hull(points)), {2500, 1e10, 0.2}, up > 0.0 ? order : 1);
    block.fixed = up < 0.0;
    blocks.emplace_back(std::move(block));
  }
  SimulationSettings settings;
  settings.time_step = 1e-3;
  Simulation simulation(std::move(blocks), {{}, {}}, same_law({stiffness, stiffness, 0.5, 0.0, 0.0, true}),
                        settings);
  double deepest = 0.0;
  while (!simulation.reached(0.3)) {
    EXPECT_EQ(simulation.step(0.3), StepStatus::accepted);
    deepest = std::max(deepest, -place_of(simulation, 1, Vector3::Zero()).z());
  }
  return deepest;
}

TEST(InternalEdges, ARidgeStandsOnARidge) {
  // Both flanks of a ridge are narrow while it has hardly gone in, and each is beside the retraction of the
  // other: neither of the two is an internal edge. d deep, each of two parallel pairs of flanks has a width
  // and a depth of d/sqrt(2), and they hold k L d^2/sqrt(2).
  std::vector<Vector3> corners;
  for (const double y : {-0.5, 0.5}) {
    corners.emplace_back(0.0, y, 0.0);
    for (const double side : {-0.5, 0.5}) {
      corners.emplace_back(side, y, 0.5);
      corners.emplace_back(side, y, 0.75);
    }
  }
  const double stiffness = 1e10;
  const double at_rest = std::sqrt(std::sqrt(2.0) * 2500.0 * 9.81 * 0.5 / stiffness);
  for (const int order : {1, 2}) {
    const double deepest = deepest_on_mirror_image(corners, order, stiffness);
    EXPECT_GT(deepest, at_rest);
    EXPECT_LT(deepest, 2.5 * at_rest) << "sqrt(3) from rest, more as springs are found anew";
  }
}

TEST(InternalEdges, ATipStandsOnATip) {
  // Pyramids with slopes of 45 degrees: seen from above they share a square of d^2, d deep in its middle and
  // 0 at its sides, and four flanks hold k d^3/3.
  const std::vector<Vector3> corners = {
      {0, 0, 0}, {-0.5, -0.5, 0.5}, {0.5, -0.5, 0.5}, {0.5, 0.5, 0.5}, {-0.5, 0.5, 0.5}};
  const double stiffness = 1e11;
  const double at_rest = std::cbrt(3.0 * 2500.0 * 9.81 * (0.5 / 3.0) / stiffness);
  const double deepest = deepest_on_mirror_image(corners, 1, stiffness);
  EXPECT_GT(deepest, at_rest);
  EXPECT_LT(deepest, 2.5 * at_rest) << "cbrt(4) from rest, more as springs are found anew";
}

/// A cube that is `deep` in a floor and runs against a step of a height.
PairContacts against_step(double deep, double height, const std::vector<Retraction>& retractions) {
  const test_support::PlacedBody cube(test_support::box({0, 0, -deep}, {1, 1, 1}));
  const test_support::PlacedBody step(test_support::box({1 - 1e-4, 0, -1}, {2, 1, height}));
  PairContacts contacts = find_contacts(cube.placed, step.placed, {1e-3, 1e-3, 0.1});
  remove_internal_edges(
      cube.placed, step.placed, retractions, [](const Retraction&) { return true; }, contacts);
  return contacts;
}

TEST(InternalEdges, OnlyWhatSinkingMakesIsLeftOut) {
  const std::vector<Retraction> retractions = {{Vector3::UnitZ(), 2e-5, {0, 2}, false}};
  const auto faces_along = [](const PairContacts& contacts, int axis) {
    return std::count_if(
        contacts.overlaps.begin(), contacts.overlaps.end(),
        [axis](const CellOverlap& overlap) { return std::abs(overlap.frame.w[axis]) > 0.9; });
  };
  // Before, the side of the step; after, only its top.
  EXPECT_GT(faces_along(against_step(1e-5, 0.0, {}), 0), 0);
  EXPECT_EQ(faces_along(against_step(1e-5, 0.0, retractions), 0), 0);
  EXPECT_GT(faces_along(against_step(1e-5, 0.0, retractions), 2), 0);
  // A step that is higher than the cube has sunk stops it.
  EXPECT_GT(faces_along(against_step(1e-5, 1e-3, retractions), 0), 0);
}

}  // namespace
}  // namespace ashlar::internal_edges_test
