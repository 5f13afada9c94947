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
using test_support::wall;

constexpr std::uint64_t scene_hash = 7;

/// Checkpoint without pairs.
RunCheckpoint values_of(const Simulation& simulation) {
  return {simulation.snapshot_without_pairs(), {}, {}, {}, {}, {}};
}

TEST(RunCheckpoint, PairsThatAreVisitedAreWrittenAsThoseOfASnapshot) {
  const TemporaryFolder folder;
  const Scene scene = wall(5, 6);
  std::vector<BlockModel> blocks;
  for (const BlockDefinition& block : scene.blocks) blocks.emplace_back(block);
  Simulation simulation(std::move(blocks), scene.motions, test_support::same_law(scene.law), scene.settings);
  ASSERT_TRUE(advance(simulation, 5));
  const std::uintmax_t size =
      write_checkpoint(folder / "whole", scene_hash, {simulation.snapshot(), {}, {}, {}, {}, {}});
  PairsOfRun pairs = simulation.pairs_of_run();
  EXPECT_EQ(write_checkpoint(folder / "visited", scene_hash, values_of(simulation), &pairs), size);
  EXPECT_EQ(read_text(folder / "visited"), read_text(folder / "whole"));
}

TEST(RunCheckpoint, TheFirstOfSeveralRanksWritesThePairsOfAll) {
  const TemporaryFolder folder;
  const Scene scene = wall(5, 6);
  run_on_threads(3, [&](Ranks& own) {
    const auto load = [&](int block) { return BlockModel(scene.blocks[at(block)]); };
    Simulation simulation(
        share_blocks(own, owners_of(scene, 3), load, scene.settings, {}, nullptr, own.own() == 0),
        scene.motions, test_support::same_law(scene.law), scene.settings);
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
