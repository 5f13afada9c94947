// Blocks of several ranks that overlap as placed: the contacts of one rank, in motion, statics and from checkpoints.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "geometry/boxes/box_pairs.hpp"
#include "support/shared_runs.hpp"

namespace ashlar::shared_overlaps_test {
namespace {

using test_support::advance;
using test_support::block_of;
using test_support::distance;
using test_support::End;
using test_support::fixed_box;
using test_support::owners_of;
using test_support::run_alone;
using test_support::run_shared;
using test_support::run_static;
using test_support::Scene;
using test_support::spring_joint;
using test_support::steps_to;
using test_support::stored_snapshot;

constexpr double depth = 1e-3;

/// Pairs whose boxes meet may overlap by twice the depth.
std::map<PairKey, double> depths_of(const Scene& scene) {
  std::vector<Box> boxes;
  for (const BlockDefinition& block : scene.blocks) boxes.push_back(box_of(block.solid->mesh().points));
  std::map<PairKey, double> depths;
  for (const PairKey& pair : meeting_boxes(boxes)) depths[pair] = 2.0 * depth;
  return depths;
}

/// Columns of cubes of 0.5 m beside each other on a fixed base, each cube 1 mm in the one below.
Scene columns() {
  Scene scene;
  scene.law = spring_joint(0.6);
  scene.law.rigid = true;
  scene.settings.time_step = 2e-3;
  scene.settings.contact_distance = 2e-3;
  scene.blocks.push_back(fixed_box({-1, -1, -0.5}, {3, 1, 0}));
  for (int column = 0; column < 3; ++column) {
    for (int k = 0; k < 3; ++k) {
      const Vector3 low(0.5 * column, 0.0, (0.5 - depth) * k - depth);
      scene.blocks.push_back(
          block_of("cube", Polyhedron(make_box(low, low + Vector3(0.5, 0.5, 0.5))), {2000, 1e9, 0.2}, 1));
    }
  }
  scene.motions.resize(scene.blocks.size());
  scene.motions[9].velocity = {0.2, 0.0, 0.0};
  scene.start = [depths = depths_of(scene)](Simulation& simulation) { simulation.start_overlapping(depths); };
  return scene;
}

const std::vector<int> in_turn = {0, 1, 0, 1, 1, 0, 1, 0, 1, 0};

TEST(SharedOverlaps, AMotionIsThatOfOneRank) {
  const Scene scene = columns();
  const End one = run_alone(scene, 60);
  // Gaps are relative to the overlap: without it the cubes would be pushed up by most of it.
  EXPECT_LT(one.totals.report.penetration, 0.1 * depth);
  EXPECT_LT(distance(one, run_shared(scene, in_turn, 2, steps_to(60))), 1e-9);
  EXPECT_LT(distance(one, run_shared(scene, owners_of(scene, 3), 3, steps_to(60))), 1e-9);
}

TEST(SharedOverlaps, AllRanksKnowThem) {
  (void)run_shared(columns(), in_turn, 2, [](Simulation& simulation) {
    // 6 between cubes and 3 with the base.
    EXPECT_EQ(simulation.histories().size(), 9U);
    for (const auto& [blocks, pair] : simulation.histories()) EXPECT_NEAR(pair.overlap, depth, 1e-12);
  });
}

TEST(SharedOverlaps, EquilibriaAndCheckpointsKeepThem) {
  Scene scene = columns();
  scene.motions.clear();
  const auto stand = [](Simulation& simulation) {
    EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
  };
  EXPECT_LT(distance(run_alone(scene, stand), run_shared(scene, in_turn, 2, stand)), 1e-7);
  const std::string stored = run_shared(scene, in_turn, 2, [&](Simulation& simulation) {
    EXPECT_TRUE(advance(simulation, 10));
    return stored_snapshot(simulation);
  });
  const SimulationSnapshot snapshot = snapshot_from_bytes(stored);
  const auto overlaps = std::count_if(snapshot.run.pairs.begin(), snapshot.run.pairs.end(),
                                      [](const auto& entry) { return entry.second.overlap > 0.0; });
  EXPECT_EQ(overlaps, 9);
  const auto go_on = [&](Simulation& simulation) {
    simulation.restore(snapshot);
    EXPECT_TRUE(advance(simulation, 30));
  };
  const End one = run_alone(scene, 30);
  EXPECT_LT(distance(one, run_alone(scene, go_on)), 1e-9);
  EXPECT_LT(distance(one, run_shared(scene, {2, 1, 0, 1, 2, 0, 1, 2, 1, 0}, 3, go_on)), 1e-9);
}

}  // namespace
}  // namespace ashlar::shared_overlaps_test
