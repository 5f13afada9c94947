// Incremental blocks that several ranks share: shapes of one rank, in results, checkpoints and on new owners.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "solver/run/checkpoint.hpp"
#include "support/shared_runs.hpp"

namespace ashlar::shared_incremental_test {
namespace {

using test_support::advance;
using test_support::same_law;
using test_support::Scene;

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

template <class Run>
Shapes alone(const Scene& scene, const Run& run) {
  std::vector<BlockModel> blocks;
  for (const BlockDefinition& block : scene.blocks) blocks.emplace_back(block);
  Simulation simulation(std::move(blocks), scene.motions, same_law(scene.law), scene.settings);
  run(simulation);
  return shapes_of(simulation);
}

/// @return shapes on the first rank, which has those of all
template <class Run>
Shapes shared(const Scene& scene, const std::vector<int>& owners, int ranks, const Run& run,
              const Rebalancing& balance = {}) {
  Shapes shapes;
  run_on_threads(ranks, [&](Ranks& own) {
    const auto load = [&](int block) { return BlockModel(scene.blocks[at(block)]); };
    BlocksOfRank blocks = share_blocks(own, owners, load, scene.settings, {}, nullptr, own.own() == 0);
    blocks.shared->balance = balance;
    Simulation simulation(std::move(blocks), scene.motions, same_law(scene.law), scene.settings);
    run(simulation);
    const int repartitions = work_of_ranks(simulation).front().repartitions;
    simulation.gather_results();
    if (own.own() > 0) return;
    shapes = shapes_of(simulation);
    shapes.repartitions = repartitions;
  });
  return shapes;
}

void move(Simulation& simulation) {
  EXPECT_TRUE(advance(simulation, 60));
}

TEST(SharedIncremental, ShapesAreThoseOfOneRank) {
  const Scene scene = sliding_wall();
  const Shapes one = alone(scene, move);
  // v t - (mu g - a) t^2 / 2 = 0.034 m of the upper brick with t = 0.12 s, besides its turn.
  EXPECT_GT(distance(alone(scene, [](Simulation&) {}), one), 0.03);
  for (const int ranks : {2, 3})
    EXPECT_LT(distance(one, shared(scene, test_support::owners_of(scene, ranks), ranks, move)), 1e-9);
}

TEST(SharedIncremental, CheckpointsGoOnWithAnyNumberOfRanks) {
  const Scene scene = sliding_wall();
  const Shapes one = alone(scene, move);
  std::string stored;
  (void)shared(scene, test_support::owners_of(scene, 3), 3, [&](Simulation& simulation) {
    EXPECT_TRUE(advance(simulation, 20));
    simulation.gather_results();
    const SimulationSnapshot snapshot = simulation.snapshot();
    if (simulation.system().share()->ranks().own() == 0) stored = to_bytes(snapshot);
  });
  const auto go_on = [&](Simulation& simulation) {
    simulation.restore(snapshot_from_bytes(stored));
    move(simulation);
  };
  EXPECT_LT(distance(one, alone(scene, go_on)), 1e-9);
  EXPECT_LT(distance(one, shared(scene, test_support::owners_of(scene, 2), 2, go_on)), 1e-9);
}

TEST(SharedIncremental, BlocksTakeTheirShapesToOtherRanks) {
  const Scene scene = sliding_wall();
  const std::vector<int> later = test_support::owners_of(scene, 2);
  Rebalancing balance;
  balance.interval = 20;
  balance.partition = [&](Ranks&, const std::vector<PartitionBlock>&, int) { return later; };
  std::vector<int> owners(scene.blocks.size(), 0);
  owners.back() = 1;
  const Shapes shapes = shared(scene, owners, 2, move, balance);
  EXPECT_EQ(shapes.repartitions, 1);
  EXPECT_LT(distance(alone(scene, move), shapes), 1e-9);
}

}  // namespace
}  // namespace ashlar::shared_incremental_test
