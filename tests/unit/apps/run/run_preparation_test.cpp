#include "apps/run/run_preparation.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>

#include "apps/run/run_setup.hpp"
#include "unit/apps/results/ended_run.hpp"
#include "unit/apps/run/cube_on_slope.hpp"

namespace ashlar::run_preparation_test {
namespace {

using Next = RunPreparation::Next;

RunStages stages_of(const std::string& text) {
  const auto scene = std::make_shared<const LoadedScene>(test::loaded_scene(text));
  Diagnostics faults;
  std::optional<BuiltSimulation> built = build_first_stage(stage_scene(scene, 0), 1, faults);
  return {scene, std::move(built).value(), 1, {}};
}

/// Ends a run when it is first asked.
struct Refusal final : RunObserver {
  [[nodiscard]] bool may_continue() override { return false; }
};

TEST(RunPreparation, WithoutAnythingToPrepareTheRunBeginsAtOnce) {
  RunStages stages = stages_of(test::cube_on_slope("end_time = 0.01, time_step = 1e-3"));
  const RunRecord record({});
  RunEnd end;
  RunPreparation preparation;
  EXPECT_EQ(preparation.next(), Next::accuracy);
  EXPECT_TRUE(preparation.allows_checkpoint());
  preparation.advance(stages, record, end);
  EXPECT_EQ(preparation.next(), Next::begin);
  EXPECT_FALSE(preparation.allows_checkpoint());
  EXPECT_FALSE(end.status);
  EXPECT_EQ(preparation.accuracy(), nullptr);
  preparation.finish();
  EXPECT_EQ(preparation.next(), Next::nothing);
}

TEST(RunPreparation, ASearchIsTakenPieceByPiece) {
  RunStages stages = stages_of(
      test::cube_on_slope("type = \"factor-of-safety\", method = \"elastic\", safety = { tolerance = 0.5 }"));
  const RunRecord record({});
  RunEnd end;
  RunPreparation preparation;
  int pieces = 0;
  do {
    preparation.advance(stages, record, end);
    ++pieces;
    EXPECT_EQ(preparation.answer().bracket.has_value(), preparation.next() != Next::answer);
  } while (preparation.next() == Next::answer);
  EXPECT_GT(pieces, 2);
  EXPECT_EQ(preparation.next(), Next::begin);
  EXPECT_FALSE(end.status);
}

TEST(RunPreparation, AnObserverEndsASearch) {
  RunStages stages = stages_of(test::cube_on_slope("type = \"factor-of-safety\", method = \"limit\""));
  RunRecord record({});
  record.add(std::make_shared<Refusal>());
  RunEnd end;
  RunPreparation preparation;
  preparation.advance(stages, record, end);
  EXPECT_EQ(end.status, RunStatus::interrupted);
  EXPECT_TRUE(end.message.starts_with("interrupted after ")) << end.message;
  EXPECT_FALSE(preparation.answer().limits) << "nothing of it is shown";
}

TEST(RunPreparation, AChoiceThatIsEndedBeginsAnew) {
  const RunRecord record({});
  RunRecord refusing({});
  refusing.add(std::make_shared<Refusal>());
  RunStages stages = stages_of(test::cube_on_slope("type = \"static\", accuracy = 0.1"));
  RunEnd end;
  RunPreparation preparation;
  preparation.advance(stages, refusing, end);
  EXPECT_EQ(end.status, RunStatus::interrupted);
  EXPECT_EQ(end.message, "interrupted while orders and steps were chosen");
  EXPECT_EQ(preparation.next(), Next::accuracy);
  end.status.reset();
  preparation.advance(stages, record, end);
  EXPECT_EQ(preparation.next(), Next::begin);
  EXPECT_NE(preparation.accuracy(), nullptr);
}

TEST(RunPreparation, ACheckpointReplacesTheChoice) {
  RunStages stages = stages_of(test::cube_on_slope("type = \"static\", accuracy = 0.1"));
  RunCheckpoint checkpoint;
  checkpoint.accuracy.rounds = 7;
  RunPreparation preparation;
  preparation.resume(stages.whole(), checkpoint);
  EXPECT_NE(preparation.checkpoint(), nullptr);
  const RunRecord record({});
  RunEnd end;
  preparation.advance(stages, record, end);
  EXPECT_EQ(preparation.next(), Next::begin);
  ASSERT_NE(preparation.accuracy(), nullptr);
  EXPECT_EQ(preparation.accuracy()->rounds, 7);
  preparation.finish();
  EXPECT_EQ(preparation.checkpoint(), nullptr);
}

}  // namespace
}  // namespace ashlar::run_preparation_test
