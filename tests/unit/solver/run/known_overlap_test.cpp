// Blocks that are placed in each other by a known depth (solver/notes/known_overlaps.md).
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar::known_overlap_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::place_of;
using test_support::run_until;
using test_support::same_law;

constexpr double depth = 1e-4;      // m
constexpr double stiffness = 2e10;  // Pa/m
constexpr double weight = 2500.0 * (1.0 + depth) * 9.81;
const Material stone{2500.0, 1e10, 0.2};

/// A cube of 1 m that is placed in a floor. @param left,right how deep its sole is at both ends, m
struct Placed {
  double left = depth;
  double right = depth;
  double known = depth;
  double gravity = 9.81;
  double friction = 0.5;
  int order = 1;
  bool multipliers = false;
  double speed = 0.0;  ///< along the floor
};

Polyhedron sunk_cube(const Placed& placed) {
  TriangleMesh mesh = make_box({0, 0, 0}, {1, 1, 1});
  for (Vector3& point : mesh.points)
    if (point.z() == 0.0) point.z() = -(placed.left + point.x() * (placed.right - placed.left));
  return Polyhedron(std::move(mesh));
}

Simulation simulation_of(const Placed& placed) {
  SimulationSettings settings;
  settings.gravity = Vector3(0, 0, -placed.gravity);
  settings.time_step = 1e-3;
  settings.augmented = placed.multipliers;
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-2, -2, -1}, {3, 3, 0}));
  blocks.emplace_back(block_of("cube", sunk_cube(placed), stone, placed.order));
  const JointLaw law{stiffness, 0.5 * stiffness, placed.friction, 0.0, 0.0, true};
  Simulation simulation(std::move(blocks), {{}, {Vector3(placed.speed, 0, 0), Vector3::Zero()}},
                        same_law(law), settings);
  if (placed.known > 0.0) simulation.start_overlapping({{{0, 1}, placed.known}});
  return simulation;
}

/// Largest displacement of a corner of the cube, m.
double moved(const Simulation& simulation) {
  double farthest = 0.0;
  for (const Vector3& point : simulation.blocks()[1].solid().mesh().points)
    farthest = std::max(farthest, (place_of(simulation, 1, point) - point).norm());
  return farthest;
}

// Without gravity nothing moves, with any kind of contact and any overlap: as deep at
// both ends, deeper at one, and at one end above the floor.
TEST(KnownOverlap, StartsWithoutForce) {
  for (const bool multipliers : {false, true}) {
    for (const int order : {0, 1, 2}) {
      for (const double right : {depth, 0.3 * depth, -0.5 * depth}) {
        Placed placed{depth, right};
        placed.gravity = 0.0;
        placed.order = order;
        placed.multipliers = multipliers;
        Simulation simulation = simulation_of(placed);
        ASSERT_TRUE(run_until(simulation, 0.02)) << multipliers << order << right;
        EXPECT_LT(moved(simulation), 1e-13) << multipliers << order << right;
        EXPECT_GT(simulation.report().locked + simulation.report().sliding, 0);
        EXPECT_LT(simulation.report().penetration, 1e-14);
        EXPECT_LT(simulation.deepest().depth, 1e-14) << "beyond what it was placed";
      }
    }
  }
}

// Springs of 2e10 N/m that are pressed by 1e-4 m throw 2500 kg off with 0.28 m/s.
TEST(KnownOverlap, ThatIsNotKnownThrowsTheBlock) {
  Placed placed;
  placed.known = 0.0;
  placed.gravity = 0.0;
  placed.order = 0;
  Simulation simulation = simulation_of(placed);
  ASSERT_TRUE(run_until(simulation, 0.02));
  EXPECT_GT(moved(simulation), 0.5 * depth);
}

// At rest a rigid cube has gone down by its weight over the springs' stiffness from where it was placed; on
// multipliers it stays there.
TEST(KnownOverlap, IsWhereContactBegins) {
  for (const bool multipliers : {false, true}) {
    Placed placed;
    placed.order = 0;
    placed.multipliers = multipliers;
    Simulation simulation = simulation_of(placed);
    ASSERT_EQ(test_support::run_static(simulation, 1.0), StaticStatus::equilibrium);
    const double sunk = multipliers ? 0.0 : weight / stiffness;
    EXPECT_NEAR(place_of(simulation, 1, Vector3(0.5, 0.5, 0.5)).z(), 0.5 - sunk, 1e-12);
    EXPECT_NEAR(simulation.report().penetration, sunk, 1e-12);
    EXPECT_NEAR(simulation.report().depth, sunk, 1e-12) << "beyond what it was placed";
  }
}

// The depth belongs to material points: a cube that slides along keeps it, and half of the known depth
// as well.
TEST(KnownOverlap, GoesAlongWhereABlockSlides) {
  Placed placed;
  placed.gravity = 0.0;
  placed.friction = 0.0;
  placed.speed = 1.0;
  Simulation simulation = simulation_of(placed);
  ASSERT_TRUE(run_until(simulation, 0.5));
  EXPECT_NEAR(place_of(simulation, 1, Vector3::Zero()).x(), 0.5, 1e-9);
  for (const Vector3& point : simulation.blocks()[1].solid().mesh().points)
    EXPECT_NEAR(place_of(simulation, 1, point).z(), point.z(), 1e-12);
}

// 0.05 m is five times the depth that no contact may leave unknown, and the springs are not a joint's.
TEST(KnownOverlap, IsAllowedToThePairByTheDepthAudit) {
  Placed placed{0.05, 0.05, 0.05};
  Simulation known = simulation_of(placed);
  EXPECT_TRUE(run_until(known, 0.02));
  EXPECT_LT(known.deepest().depth, 1e-5);
  EXPECT_LT(moved(known), 1e-5);
}

TEST(KnownOverlap, GoesOnToTheSameBitsFromACheckpoint) {
  Placed placed{depth, 0.3 * depth};
  placed.speed = 0.2;
  Simulation whole = simulation_of(placed);
  for (int k = 0; k < 10; ++k) ASSERT_EQ(whole.step(1.0), StepStatus::accepted);
  const std::string bytes = to_bytes(whole.snapshot());
  placed.known = 0.0;  // the snapshot has it
  Simulation resumed = simulation_of(placed);
  resumed.restore(snapshot_from_bytes(bytes));
  for (int k = 0; k < 20; ++k) {
    ASSERT_EQ(whole.step(1.0), StepStatus::accepted);
    ASSERT_EQ(resumed.step(1.0), StepStatus::accepted);
    EXPECT_EQ(resumed.states()[1].position, whole.states()[1].position);
    EXPECT_EQ(resumed.states()[1].velocity, whole.states()[1].velocity);
  }
}

TEST(KnownOverlap, IsNotOfIncrementalBlocks) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-2, -2, -1}, {3, 3, 0}));
  BlockDefinition cube = block_of("cube", sunk_cube({}), stone, 1);
  cube.formulation = Formulation::incremental;
  blocks.emplace_back(std::move(cube));
  Simulation simulation(std::move(blocks), {{}, {}}, same_law({stiffness, stiffness, 0.5, 0.0, 0.0, true}),
                        {});
  EXPECT_THROW(simulation.start_overlapping({{{0, 1}, depth}}), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::known_overlap_test
