// Runs with analysis.accuracy.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>
#include <string>

#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/results/tables/history_table.hpp"
#include "apps/run/accuracy_choice.hpp"
#include "apps/run/run.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::accuracy_run_test {
namespace {

using ::testing::HasSubstr;

LoadedScene loaded(const std::string& text) {
  Diagnostics faults;
  auto scene = load_scene_text(text, "test.toml", {}, faults);
  if (!scene) throw std::invalid_argument(to_string(faults.sorted().front()));
  return std::move(*scene);
}

/// A pier of 2 m on a floor under its weight of 20 kPa at the foot, nu = 0. Its middle sinks by
/// 3/4 rho g h^2 / 2E = 3e-5 m.
std::string pier(const std::string& analysis, const std::string& more = "") {
  return "analysis = { gravity = [0, 0, -10], " + analysis + R"( }
contact = { friction_angle = 30 }
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0 }]
[[block]]
name = "floor"
fixed = true
box = { min = [-1, -1, -1], max = [2, 2, 0] }
[[block]]
name = "pier"
material = "stone"
box = { min = [0, 0, 0], max = [1, 1, 2] }
)" + more +
         R"(
[[measure]]
name = "middle"
block = "pier"
point = [0.5, 0.5, 1]
)";
}

nlohmann::json error_of(const ashlar::Run& run) {
  return nlohmann::json::parse(run.summary())["error"];
}

// Order 1 has the mean strain: its middle sinks by 1/2 rho g h^2 / 2E, two thirds of 3/4.
TEST(AccuracyRun, AStaticRunWithoutAccuracyTellsTheErrorOfItsMeasures) {
  for (const int order : {1, 2}) {
    ashlar::Run run(loaded(pier("type = \"static\"", fmt::format("order = {}", order))));
    while (run.step()) {
      EXPECT_TRUE(run.measure_errors().empty()) << "not before the equilibrium";
    }
    ASSERT_EQ(run.status(), RunStatus::equilibrium);
    const auto error = error_of(run);
    EXPECT_EQ(error["measures"].size(), 1U);
    EXPECT_NEAR(error["measures"]["middle"], order == 1 ? 1.0 / 3.0 : 0.0, 1e-3) << order;
  }
  ashlar::Run asked(loaded(pier("type = \"static\", accuracy = 1e-2")));
  while (asked.step()) {
  }
  EXPECT_TRUE(asked.measure_errors().empty()) << "known from the choice";
}

TEST(AccuracyRun, ErrorsThatAreAskedForAreThoseOfTheSummaryOfASmallRun) {
  for (const char* analysis : {"type = \"static\"", "type = \"static\", accuracy = 1e-2"}) {
    ashlar::Run run(loaded(pier(analysis, "order = 1")));
    while (run.step()) {
    }
    EXPECT_EQ(nlohmann::json::parse(run.errors()), error_of(run)) << analysis;
  }
  ashlar::Run run(loaded(
      pier("type = \"static\"",
           "order = 1\nload = [{ plane = { point = [0, 0, 2], normal = [0, 0, 1] }, force = [0, 0, -1] }]")));
  EXPECT_EQ(run.errors(), "null") << "it is no equilibrium";
  while (run.step()) {
  }
  EXPECT_EQ(run.summary_order_errors().blocks, 1);
  EXPECT_EQ(error_of(run)["blocks_estimated"], 1);
  run.set_load_factor("pier", 0, 1.0);
  EXPECT_TRUE(run.summary_order_errors().errors.empty()) << "it goes on";
}

TEST(AccuracyRun, AStaticRunHasTheChosenOrder) {
  ashlar::Run run(loaded(pier("type = \"static\", accuracy = 1e-3")));
  while (run.step()) {
  }
  ASSERT_EQ(run.status(), RunStatus::equilibrium);
  EXPECT_NEAR(run.motion("pier", {0.5, 0.5, 1}).displacement.z(), -3e-5, 1e-3 * 3e-5);
  const auto error = error_of(run);
  EXPECT_EQ(error["accuracy"], 1e-3);
  EXPECT_LE(error["estimate"], 1e-3);
  EXPECT_EQ(error["estimate"], error["measures"]["middle"]);
  EXPECT_EQ(error["orders"].size(), 1U) << "of the pier alone";
  EXPECT_GE(run.simulation().blocks()[1].order(), 2);
  EXPECT_EQ(error["advice"], "");
  EXPECT_FALSE(error["by"].contains("step"));
}

TEST(AccuracyRun, AGivenOrderStaysAndIsNamed) {
  ashlar::Run run(loaded(pier("type = \"static\", accuracy = 1e-3", "order = 1")));
  while (run.step()) {
  }
  ASSERT_EQ(run.status(), RunStatus::equilibrium);
  EXPECT_EQ(run.simulation().blocks()[1].order(), 1);
  const auto error = error_of(run);
  // In the norm of the energy, of which order 1 lacks a quarter.
  EXPECT_NEAR(error["estimate"], 0.5, 0.01);
  EXPECT_THAT(std::string(error["advice"]), HasSubstr("given or highest orders"));
}

/// A bar of 2 m that is held at its top and let go, nu = 0. With uniform strain its foot moves by
/// (rho g h^2 / 2E)(1 - cos w t), w^2 = 3E / (rho h^2): 4e-4 m after 2 1/4 periods of 0.03245 s, at most 8e-4 m.
std::string bar(double accuracy) {
  constexpr double end = 2.25 * 2.0 * std::numbers::pi * 2.0 / 387.2983346207417;
  return fmt::format(R"(
analysis = {{ gravity = [0, 0, -10], end_time = {:.17g}, accuracy = {}, integrator = "average-acceleration" }}
material = [{{ name = "stone", density = 2000, young_modulus = 1e8, poisson_ratio = 0 }}]
[[block]]
name = "bar"
material = "stone"
order = 1
box = {{ min = [0, 0, 0], max = [1, 1, 2] }}
fix = [{{ plane = {{ point = [0, 0, 2], normal = [0, 0, 1] }} }}]
[[measure]]
name = "foot"
block = "bar"
point = [0.5, 0.5, 0]
)",
                     end, accuracy);
}

TEST(AccuracyRun, TheStepOfAMotionIsChosen) {
  for (const double accuracy : {1e-1, 1e-2, 1e-3}) {
    ashlar::Run run(loaded(bar(accuracy)));
    while (run.step()) {
    }
    ASSERT_EQ(run.status(), RunStatus::completed);
    constexpr double largest = 8e-4;
    const double error = std::abs(run.motion("bar", {0.5, 0.5, 0}).displacement.z() + 4e-4) / largest;
    EXPECT_LE(error, accuracy) << run.simulation().steps();
    EXPECT_GE(error, 0.02 * accuracy) << run.simulation().steps();
    const auto told = error_of(run);
    EXPECT_LE(error, 2.0 * double(told["by"]["step"]));
    EXPECT_GE(error, 0.1 * double(told["by"]["step"]));
    EXPECT_GE(told["measures"]["foot"], told["by"]["step"]);
    EXPECT_EQ(told["steps_with_impacts"], 0);
    EXPECT_GT(told["steps_tested"], 0);
  }
}

TEST(AccuracyRun, AResumedRunHasTheSameBits) {
  const std::string scene = bar(1e-2) + "[output]\nevery = 1000\n";
  const TemporaryFolder folder;
  ashlar::Run straight(loaded(scene));
  while (straight.step()) {
  }
  {
    ashlar::Run first(loaded(scene));
    first.record(folder.path() / "out");
    for (int k = 0; k < 20; ++k) (void)first.step();
    write_checkpoint(folder.path() / "kept", 1, first.checkpoint());
  }
  ashlar::Run second(loaded(scene));
  second.resume(read_checkpoint(folder.path() / "kept", 1));
  while (second.step()) {
  }
  EXPECT_EQ(second.simulation().states()[0].position, straight.simulation().states()[0].position);
  EXPECT_EQ(second.simulation().steps(), straight.simulation().steps());
  EXPECT_EQ(error_of(second)["estimate"], error_of(straight)["estimate"]);
}

TEST(AccuracyRun, AResumedStaticRunKeepsItsOrders) {
  ashlar::Run first(loaded(pier("type = \"static\", accuracy = 1e-3")));
  (void)first.step();
  ashlar::Run second(loaded(pier("type = \"static\", accuracy = 1e-3")));
  second.resume(first.checkpoint());
  EXPECT_EQ(second.simulation().blocks()[1].order(), first.simulation().blocks()[1].order());
  while (first.step()) {
  }
  while (second.step()) {
  }
  EXPECT_EQ(second.simulation().states()[1].position, first.simulation().states()[1].position);
}

// With a history the step is at most its shortest interval.
TEST(AccuracyRun, HistoriesBoundTheStep) {
  const LoadedScene scene = loaded(R"(
analysis = { gravity_history = [[0, 0, 0, 0], [0.1, 0, 0, -1], [0.15, 0, 0, 0]], end_time = 10, accuracy = 1e-1 }
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0 }]
[[block]]
name = "pier"
material = "stone"
order = 0
box = { min = [0, 0, 0], max = [1, 1, 2] }
)");
  EXPECT_NEAR(motion_request(scene.scene).longest_step, 0.05, 1e-12);
}

TEST(AccuracyRun, TheChoiceCanBeEnded) {
  const LoadedScene scene = loaded(pier("type = \"static\", accuracy = 1e-3"));
  EXPECT_FALSE(choose_for_accuracy(scene, 1, [] { return false; }));
  EXPECT_FALSE(choose_for_accuracy(loaded(bar(1e-2)), 1, [] { return false; }));
}

}  // namespace
}  // namespace ashlar::accuracy_run_test
