#include "apps/run/run_stages.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>

#include "apps/run/run_setup.hpp"
#include "unit/apps/results/ended_run.hpp"

namespace ashlar::run_stages_test {
namespace {

const std::string cube = R"(
analysis = { end_time = 0.02, time_step = 1e-3, gravity = [0, 0, 0] }
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0 }]
[[block]]
name = "cube"
material = "stone"
box = { min = [0, 0, 0], max = [1, 1, 1] }
velocity = [1, 0, 0]
)";

const std::string two_stages = R"(
[[stage]]
name = "one"
analysis = { end_time = 0.003 }
[[stage]]
name = "two"
analysis = { end_time = 0.002 }
)";

RunStages stages_of(const std::string& text) {
  const auto scene = std::make_shared<const LoadedScene>(test::loaded_scene(text));
  Diagnostics faults;
  std::optional<BuiltSimulation> built = build_first_stage(stage_scene(scene, 0), 1, faults);
  return {scene, std::move(built).value(), 1, {}};
}

void go_to_end(RunStages& stages) {
  stages.enter();
  while (!stages.simulation().reached(stages.scene().analysis.end_time))
    (void)stages.simulation().step(stages.scene().analysis.end_time);
}

TEST(RunStages, ASceneWithoutStagesIsOne) {
  RunStages stages = stages_of(cube);
  EXPECT_EQ(stages.number(), 0);
  EXPECT_EQ(stages.next(), RunStages::Next::first_step);
  stages.enter();
  EXPECT_EQ(stages.next(), RunStages::Next::step);
  EXPECT_FALSE(stages.end(true)) << "nothing follows";
  EXPECT_EQ(stages.next(), RunStages::Next::step);
}

TEST(RunStages, AStageFollowsOneThatEndsAsItShould) {
  RunStages stages = stages_of(cube + two_stages);
  EXPECT_EQ(stages.number(), 1);
  go_to_end(stages);
  EXPECT_FALSE(stages.end(false));
  EXPECT_TRUE(stages.end(true));
  EXPECT_EQ(stages.next(), RunStages::Next::next_stage);
  stages.reopen();
  EXPECT_EQ(stages.next(), RunStages::Next::step);
  EXPECT_TRUE(stages.end(true));
  EXPECT_EQ(stages.begin_next({"completed", "", 3, 0.003}), std::nullopt);
  EXPECT_EQ(stages.number(), 2);
  EXPECT_EQ(stages.next(), RunStages::Next::first_step);
  EXPECT_NEAR(stages.place().elapsed, 0.003, 1e-12);
  EXPECT_DOUBLE_EQ(stages.scene().analysis.end_time, 0.002);
  EXPECT_EQ(stages.simulation().time(), 0.0);
  ASSERT_EQ(stages.finished().size(), 1U);
  EXPECT_EQ(stages.finished().front().steps, 3);
  go_to_end(stages);
  EXPECT_FALSE(stages.end(true));
}

TEST(RunStages, AStageThatAddsABlockWhereAnotherIsDoesNotBegin) {
  RunStages stages = stages_of(R"(
analysis = { end_time = 1, time_step = 1e-2, gravity = [0, 0, 0] }
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0 }]
[[block]]
name = "falling"
material = "stone"
box = { min = [0, 0, 2], max = [1, 1, 3] }
velocity = [0, 0, -1.5]
[[block]]
name = "added"
material = "stone"
box = { min = [0, 0, 0], max = [1, 1, 1] }
[[stage]]
name = "one"
[[stage]]
name = "two"
add = ["added"]
)");
  go_to_end(stages);
  EXPECT_TRUE(stages.end(true));
  const std::optional<std::string> fault = stages.begin_next({"completed", "", 100, 1.0});
  ASSERT_TRUE(fault);
  EXPECT_TRUE(fault->starts_with("stage two cannot begin: ")) << *fault;
  EXPECT_EQ(stages.number(), 1);
  EXPECT_EQ(stages.next(), RunStages::Next::next_stage);
  EXPECT_TRUE(stages.finished().empty());
  EXPECT_NEAR(stages.simulation().time(), 1.0, 1e-12) << "the end of the first stage is kept";
}

}  // namespace
}  // namespace ashlar::run_stages_test
