#include "apps/results/folder/run_checkpoint.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/shared_runs.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::run_checkpoint_test {
namespace {

using test_support::advance;
using test_support::owners_of;
using test_support::Scene;
using test_support::simulation_alone;
using test_support::simulation_on;
using test_support::wall;

constexpr std::uint64_t scene_hash = 7;

/// Checkpoint without pairs.
RunCheckpoint values_of(const Simulation& simulation) {
  return {simulation.snapshot_without_pairs(), {}, {}, {}, {}, {}};
}

TEST(RunCheckpoint, PairsThatAreVisitedAreWrittenAsThoseOfASnapshot) {
  const TemporaryFolder folder;
  const Scene scene = wall(5, 6);
  Simulation simulation = simulation_alone(scene);
  ASSERT_TRUE(advance(simulation, 5));
  const std::uintmax_t size =
      write_checkpoint(folder / "whole", scene_hash, {simulation.snapshot(), {}, {}, {}, {}, {}});
  PairsOfRun pairs = simulation.pairs_of_run();
  EXPECT_EQ(write_checkpoint(folder / "visited", scene_hash, values_of(simulation), &pairs), size);
  EXPECT_EQ(read_text(folder / "visited"), read_text(folder / "whole"));
}

TEST(RunCheckpoint, PairsThatAreNotNeededAreReadWithTheirOverlapAlone) {
  const TemporaryFolder folder;
  const Scene scene = wall(2, 3);
  Simulation simulation = simulation_alone(scene);
  ASSERT_TRUE(advance(simulation, 2));
  RunCheckpoint written{simulation.snapshot(), {}, {}, {}, {}, {}};
  // Ground 0, course of 1, 2 and 3, on which 4 and 5 are: three pairs with the ground, seven of bricks.
  ASSERT_EQ(written.simulation.run.records.size(), 10u);
  written.simulation.run.pairs.at({1, 4}).overlap = 1e-3;
  write_checkpoint(folder / "checkpoint", scene_hash, written);
  const RunCheckpoint read = read_checkpoint(
      folder / "checkpoint", scene_hash, [](const PairKey& pair) { return pair[0] == 3 || pair[1] == 3; });
  const auto keys = [](const auto& pairs, const auto& key) {
    std::vector<PairKey> result;
    for (const auto& pair : pairs) result.push_back(key(pair));
    return result;
  };
  using Keys = std::vector<PairKey>;
  EXPECT_EQ(keys(read.simulation.run.pairs, [](const auto& pair) { return pair.first; }),
            (Keys{{0, 3}, {1, 4}, {2, 3}, {3, 5}}));
  EXPECT_EQ(keys(read.simulation.run.records,
                 [](const auto& record) {
                   return PairKey{record.a, record.b};
                 }),
            (Keys{{0, 3}, {2, 3}, {3, 5}}));
  const PairHistory& other = read.simulation.run.pairs.at({1, 4});
  EXPECT_TRUE(other.memory.empty() && other.cache == nullptr);
  EXPECT_EQ(other.overlap, 1e-3);
  EXPECT_EQ(read.simulation.run.pairs.at({3, 5}).memory.entries().size(),
            written.simulation.run.pairs.at({3, 5}).memory.entries().size());
  const RunCheckpoint all =
      read_checkpoint(folder / "checkpoint", scene_hash, [](const PairKey&) { return true; });
  write_checkpoint(folder / "again", scene_hash, all);
  EXPECT_EQ(read_text(folder / "again"), read_text(folder / "checkpoint"));
}

TEST(RunCheckpoint, TheFirstOfSeveralRanksWritesThePairsOfAll) {
  const TemporaryFolder folder;
  const Scene scene = wall(5, 6);
  run_on_threads(3, [&](Ranks& own) {
    Simulation simulation = simulation_on(own, scene, owners_of(scene, 3));
    ASSERT_TRUE(advance(simulation, 5));
    simulation.gather_results({});
    SimulationSnapshot whole = simulation.snapshot();
    const RunCheckpoint values = values_of(simulation);
    PairsOfRun pairs = simulation.pairs_of_run();
    if (own.own() > 0) {
      pairs.finish();
    } else {
      write_checkpoint(folder / "visited", scene_hash, values, &pairs);
      write_checkpoint(folder / "whole", scene_hash, {std::move(whole), {}, {}, {}, {}, {}});
    }
    // A file that cannot be written.
    PairsOfRun others = simulation.pairs_of_run();
    if (own.own() > 0)
      others.finish();
    else
      EXPECT_THROW(write_checkpoint(folder / "none/checkpoint", scene_hash, values, &others),
                   std::runtime_error);
    simulation.gather_results({});
  });
  EXPECT_EQ(read_text(folder / "visited"), read_text(folder / "whole"));
  // Courses of 6, 5, 6, 5 and 6 bricks: 6 on the ground, 10 pairs of each two courses, 23 side by side.
  const RunCheckpoint stored = read_checkpoint(folder / "visited", scene_hash);
  EXPECT_EQ(stored.simulation.run.pairs.size(), 69u);
  EXPECT_EQ(stored.simulation.run.records.size(), 69u);
  EXPECT_EQ(stored.simulation.run.states.size(), scene.blocks.size());
}

}  // namespace
}  // namespace ashlar::run_checkpoint_test
