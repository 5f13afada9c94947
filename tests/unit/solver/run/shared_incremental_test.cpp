// Incremental blocks that several ranks share: shapes of one rank, in results, checkpoints and on new owners.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/shared_runs.hpp"

namespace ashlar::shared_incremental_test {
namespace {

using test_support::advance;
using test_support::looking_each;
using test_support::owners_of;
using test_support::run_alone;
using test_support::run_shared;
using test_support::Scene;
using test_support::stored_snapshot;

/// A wall in bond whose upper brick slides off.
Scene sliding_wall() {
  Scene scene = test_support::wall(3, 3);
  for (BlockDefinition& block : scene.blocks)
    if (!block.fixed) block.formulation = Formulation::incremental;
  scene.settings.gravity = {2.0, 1.0, -9.81};
  scene.motions.back() = {{0.5, 0.1, 0.0}, {0.0, 0.0, 0.3}};
  return scene;
}

/// Points of the sub-faces of all blocks at the end, in current coordinates.
struct Shapes {
  std::vector<std::vector<Vector3>> points;
  int repartitions = 0;
};

Shapes shapes_of(const Simulation& simulation) {
  Shapes shapes;
  for (const BlockModel& block : simulation.blocks())
    shapes.points.push_back(block.incremental() != nullptr ? block.carried().points : std::vector<Vector3>());
  return shapes;
}

double distance(const Shapes& one, const Shapes& other) {
  double most = one.points.size() == other.points.size() ? 0.0 : 1.0;
  for (std::size_t k = 0; k < one.points.size(); ++k)
    for (std::size_t n = 0; n < one.points[k].size(); ++n)
      most = std::max(most, (one.points[k][n] - other.points[k].at(n)).norm());
  return most;
}

/// Shapes after a number of steps, on the first rank those of all blocks.
Shapes shapes_after(Simulation& simulation, int steps) {
  EXPECT_TRUE(advance(simulation, steps));
  const int repartitions = work_of_ranks(simulation).front().repartitions;
  simulation.gather_results();
  Shapes shapes = shapes_of(simulation);
  shapes.repartitions = repartitions;
  return shapes;
}

Shapes move(Simulation& simulation) {
  return shapes_after(simulation, 60);
}

TEST(SharedIncremental, ShapesAreThoseOfOneRank) {
  const Scene scene = sliding_wall();
  const Shapes one = run_alone(scene, move);
  // v t - (mu g - a) t^2 / 2 = 0.034 m of the upper brick with t = 0.12 s, besides its turn.
  EXPECT_GT(distance(run_alone(scene, shapes_of), one), 0.03);
  for (const int ranks : {2, 3})
    EXPECT_LT(distance(one, run_shared(scene, owners_of(scene, ranks), ranks, move)), 1e-9);
}

TEST(SharedIncremental, CheckpointsGoOnWithAnyNumberOfRanks) {
  const Scene scene = sliding_wall();
  const Shapes one = run_alone(scene, move);
  const std::string stored = run_shared(scene, owners_of(scene, 3), 3, [](Simulation& simulation) {
    EXPECT_TRUE(advance(simulation, 20));
    return stored_snapshot(simulation);
  });
  const auto go_on = [&](Simulation& simulation) {
    simulation.restore(snapshot_from_bytes(stored));
    return move(simulation);
  };
  EXPECT_LT(distance(one, run_alone(scene, go_on)), 1e-9);
  EXPECT_LT(distance(one, run_shared(scene, owners_of(scene, 2), 2, go_on)), 1e-9);
}

TEST(SharedIncremental, BlocksTakeTheirShapesToOtherRanks) {
  const Scene scene = sliding_wall();
  const std::vector<int> later = owners_of(scene, 2);
  const auto partition = [&](Ranks&, const std::vector<PartitionBlock>&, int) { return later; };
  std::vector<int> owners(scene.blocks.size(), 0);
  owners.back() = 1;
  const Shapes shapes = run_shared(scene, owners, 2, move, looking_each(20, partition));
  EXPECT_EQ(shapes.repartitions, 1);
  EXPECT_LT(distance(run_alone(scene, move), shapes), 1e-9);
}

}  // namespace
}  // namespace ashlar::shared_incremental_test
