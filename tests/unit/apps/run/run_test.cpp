#include "apps/run/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/results/tables/history_table.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/run/cube_on_slope.hpp"

namespace ashlar::run_test {
namespace {

LoadedScene loaded(const std::string& text) {
  Diagnostics faults;
  auto scene = load_scene_text(text, "test.toml", {}, faults);
  if (!scene) throw std::invalid_argument(to_string(faults.sorted().front()));
  return std::move(*scene);
}

/// A cube of 2000 kg in no gravity, pushed by 2000 N along x at its centroid, unless `more` says otherwise.
std::string pushed_cube(const std::string& analysis) {
  return "analysis = { " + analysis + R"( }
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0 }]
[[block]]
name = "cube"
material = "stone"
box = { min = [0, 0, 0], max = [1, 1, 1] }
load = [{ point = [0.5, 0.5, 0.5], force = [2000, 0, 0] }]
)";
}

/// A pier of 2 m^3 and 2000 kg/m^3 on a floor, pressed by 1e5 Pa, nu = 0.
const std::string pier = R"(
analysis = { type = "static", gravity = [0, 0, -10] }
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
load = [{ plane = { point = [0, 0, 2], normal = [0, 0, 1] }, traction = [0, 0, -1e5] }]
)";

TEST(Run, ALoadChangesBetweenSteps) {
  ashlar::Run run(loaded(pushed_cube("end_time = 0.02, time_step = 1e-3, gravity = [0, 0, 0]")));
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(run.step());
  // a = 1 m/s^2
  EXPECT_NEAR(run.motion("cube", {0.5, 0.5, 0.5}).velocity.x(), 0.01, 1e-12);
  run.set_load_factor("cube", 0, -3.0);
  while (run.step()) {
  }
  EXPECT_NEAR(run.motion("cube", {0.5, 0.5, 0.5}).velocity.x(), 0.01 - 0.03, 1e-12);
  EXPECT_EQ(run.status(), RunStatus::completed);
  EXPECT_FALSE(run.step());
  EXPECT_EQ(run.rows().size(), 21U);
  EXPECT_EQ(run.columns().size(), run.rows().back().size());
}

TEST(Run, TheWorkOfAChangedLoadIsInTheLedger) {
  ashlar::Run run(loaded(pushed_cube("end_time = 0.02, time_step = 1e-3, gravity = [0, 0, 0]")));
  run.set_load_factor("cube", 0, 5.0);
  while (run.step()) {
  }
  // v = 5 * 0.02, of 2000 kg
  const double kinetic = 0.5 * 2000.0 * 0.1 * 0.1;
  const Ledger& ledger = run.simulation().ledger();
  EXPECT_NEAR(ledger.kinetic, kinetic, 1e-9 * kinetic);
  EXPECT_NEAR(ledger.residual, 0.0, 1e-9 * kinetic);
}

TEST(Run, WrongLoadsChangeNothing) {
  ashlar::Run run(loaded(pushed_cube("end_time = 0.02, time_step = 1e-3, gravity = [0, 0, 0]")));
  EXPECT_THROW(run.set_load_factor("ball", 0, 1.0), std::out_of_range);
  EXPECT_THROW(run.set_load_factor("cube", 1, 1.0), std::out_of_range);
  EXPECT_THROW(run.set_load_factor("cube", -1, 1.0), std::out_of_range);
  EXPECT_THROW(run.set_load_factor("cube", 0, std::numeric_limits<double>::infinity()),
               std::invalid_argument);
  EXPECT_THROW((void)run.motion("ball", {0, 0, 0}), std::out_of_range);
  (void)run.step();
  EXPECT_NEAR(run.motion("cube", {0.5, 0.5, 0.5}).velocity.x(), 0.001, 1e-14);
}

TEST(Run, AStaticAnalysisGoesOnUnderANewLoad) {
  ashlar::Run run(loaded(pier));
  for (const double factor : {1.0, 2.0, 0.5}) {
    run.set_load_factor("pier", 0, factor);
    while (run.step()) {
    }
    EXPECT_EQ(run.status(), RunStatus::equilibrium);
    const double expected = -(factor * 1e5 + 2000.0 * 10.0 * 1.0);
    EXPECT_NEAR(run.motion("pier", {0.5, 0.5, 1.0}).stress(2, 2), expected, 1e-3 * std::abs(expected));
  }
}

TEST(Run, WhatIsTooMuchMoves) {
  std::string pushed = pier;
  pushed.insert(pushed.rfind(']'), ", { point = [0, 0.5, 0], force = [1, 0, 0] }");
  ashlar::Run run(loaded(pushed));
  while (run.step()) {
  }
  EXPECT_EQ(run.status(), RunStatus::equilibrium);
  // Friction bears tan(30) of 40 kN of weight and 100 kN of load at most.
  run.set_load_factor("pier", 1, 1e5);
  while (run.step()) {
  }
  EXPECT_EQ(run.status(), RunStatus::moving);
  EXPECT_NE(run.message().find("block pier moves"), std::string::npos) << run.message();
}

TEST(Run, StagesFollowEachOther) {
  ashlar::Run run(loaded(pier + R"(
[[stage]]
name = "load"
[[stage]]
name = "more"
load = [{ blocks = ["pier"], plane = { point = [0, 0, 2], normal = [0, 0, 1] }, traction = [0, 0, -2e5] }]
)"));
  EXPECT_EQ(run.stage(), 1);
  while (run.step()) {
  }
  EXPECT_EQ(run.stage(), 2);
  EXPECT_EQ(run.status(), RunStatus::equilibrium);
  EXPECT_NEAR(run.motion("pier", {0.5, 0.5, 1.0}).stress(2, 2), -3.2e5, 3.2e2);
  EXPECT_EQ(run.columns().back(), "stage");
  EXPECT_EQ(run.rows().front().back(), 1.0);
  EXPECT_EQ(run.rows().back().back(), 2.0);
}

TEST(Run, PointsThatAreNotOfABlockAreRefused) {
  const ashlar::Run run(loaded(pier));
  EXPECT_EQ(run.motion("pier", {1.0, 1.0, 2.0}).place, Vector3(1.0, 1.0, 2.0)) << "a corner is of the block";
  EXPECT_THROW((void)run.motion("pier", {0.5, 0.5, 2.5}), std::domain_error);
  EXPECT_NO_THROW((void)run.motion("pier", {0.5, 0.5, 2.5}, OutsidePoints::extrapolated));
  EXPECT_THROW((void)run.motion("pillar", {0.5, 0.5, 1.0}), std::out_of_range);
}

TEST(Run, WritesAndRecordsTheSameHistory) {
  const TemporaryFolder folder;
  ashlar::Run run(loaded(pushed_cube("end_time = 0.02, time_step = 1e-3, gravity = [0, 0, 0]")));
  run.record(folder / "recorded");
  while (run.step()) {
  }
  run.write(folder / "written");
  const HistoryTable recorded = read_history(folder / "recorded" / "history.csv", 1000);
  const HistoryTable written = read_history(folder / "written" / "history.csv", 1000);
  EXPECT_EQ(recorded.columns, run.columns());
  EXPECT_EQ(recorded.rows, run.rows());
  EXPECT_EQ(written.rows, run.rows());
  EXPECT_TRUE(std::filesystem::exists(folder / "recorded" / "summary.json"));
  EXPECT_TRUE(std::filesystem::exists(folder / "recorded" / "frames" / "blocks_0000020.vtu"));
  ashlar::Run another(loaded(pushed_cube("end_time = 0.02, time_step = 1e-3, gravity = [0, 0, 0]")));
  EXPECT_THROW(another.record(folder / "written"), ClaimRefused);
  // One recording at a time, and none of what is over.
  another.record(folder / "other");
  EXPECT_THROW(another.record(folder / "third"), std::logic_error);
  EXPECT_THROW(run.record(folder / "third"), std::logic_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "third"));
}

TEST(Run, ASearchForAFactorEndsWithIt) {
  for (const char* method : {"limit", "elastic"}) {
    ashlar::Run run(
        loaded(test::cube_on_slope(std::string("type = \"factor-of-safety\", method = \"") + method + '"')));
    EXPECT_TRUE(run.rows().empty()) << "its motion is shown once the factor is known";
    EXPECT_THROW(run.set_load_factor("cube", 0, 2.0), std::logic_error);
    while (run.step()) {
    }
    EXPECT_EQ(run.status(), RunStatus::completed) << run.message();
    const auto summary = nlohmann::json::parse(run.summary()).at("factor_of_safety");
    EXPECT_EQ(summary.at("method"), method);
    EXPECT_LE(summary.at("lower"), 1.2);
    EXPECT_GE(summary.at("upper"), 1.2);
    EXPECT_LE(summary.at("upper").get<double>(), 1.2 * 1.02);
    EXPECT_EQ(run.answer().bracket.has_value(), std::string(method) == "elastic");
    EXPECT_TRUE(run.answer().limits);
    EXPECT_EQ(run.answer().shows_states(), std::string(method) == "limit");
    EXPECT_GE(run.rows().size(), 2U);
  }
}

TEST(Run, ASearchIsStepped) {
  ashlar::Run run(loaded(test::cube_on_slope("type = \"factor-of-safety\", method = \"elastic\"")));
  // Limit analysis first, then iterations of trials: none of them is a step of the run.
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(run.step());
  EXPECT_TRUE(run.answer().shows_states() || !run.answer().limits);
  EXPECT_EQ(run.simulation().steps(), 0);
  EXPECT_FALSE(run.status());
}

/// Counts the events of a run and ends it after some questions.
struct Counter : RunObserver {
  explicit Counter(int most = 1 << 30) : left(most) {}
  bool may_continue() override { return left-- > 0; }
  void run_begins(const Run&) override { ++begun; }
  void stage_begins(const Run&) override { ++stages; }
  void step_taken(const Run&) override { ++steps; }
  void stage_ends(const Run& run) override { follows.push_back(run.stage_follows()); }
  void run_ends(const Run& run) override { ends.push_back(run.status().value()); }
  int left, begun = 0, stages = 0, steps = 0;
  std::vector<bool> follows;
  std::vector<RunStatus> ends;
};

TEST(Run, ObserversAreToldOfStepsAndStages) {
  ashlar::Run run(loaded(pushed_cube("end_time = 0.02, time_step = 1e-3") + R"(
[[stage]]
name = "one"
analysis = { end_time = 0.003 }
[[stage]]
name = "two"
analysis = { end_time = 0.002 }
)"));
  const auto early = std::make_shared<Counter>(), late = std::make_shared<Counter>();
  run.observe(early);
  EXPECT_TRUE(run.step());
  run.observe(late);
  EXPECT_EQ(late->stages, 1) << "of the stage that it found";
  while (run.step()) {
  }
  EXPECT_EQ(early->begun, 1);
  EXPECT_EQ(early->stages, 2);
  EXPECT_EQ(early->steps, 5);
  EXPECT_EQ(late->steps, 4);
  EXPECT_EQ(early->follows, (std::vector<bool>{true, false}));
  EXPECT_EQ(early->ends, std::vector<RunStatus>{RunStatus::completed});
}

TEST(Run, AnObserverEndsIt) {
  ashlar::Run run(loaded(pushed_cube("end_time = 0.02, time_step = 1e-3")));
  const auto counter = std::make_shared<Counter>(7);
  run.observe(counter);
  while (run.step()) {
  }
  EXPECT_EQ(run.status(), RunStatus::interrupted);
  EXPECT_EQ(run.simulation().steps(), 7);
  EXPECT_EQ(run.message(), "interrupted after step 7 at t = 0.007 s of 0.02 s");
  EXPECT_EQ(counter->ends, std::vector<RunStatus>{RunStatus::interrupted});
  EXPECT_FALSE(run.step());
}

TEST(Run, ARecordedRunIsResumed) {
  const TemporaryFolder folder;
  const auto make = [] { return ashlar::Run(loaded(pushed_cube("end_time = 0.02, time_step = 1e-3"))); };
  ashlar::Run whole = make();
  whole.record(folder / "whole");
  while (whole.step()) {
  }
  {
    ashlar::Run first = make();
    first.observe(std::make_shared<Counter>(7));
    first.record(folder / "out");
    while (first.step()) {
    }
  }
  {
    ashlar::Run second = make();
    second.resume(folder / "out");
    EXPECT_EQ(second.simulation().steps(), 7);
    EXPECT_THROW(second.record(folder / "other"), std::logic_error);
    EXPECT_THROW(second.resume(folder / "out"), std::logic_error);
    while (second.step()) {
    }
    EXPECT_EQ(second.status(), RunStatus::completed);
    EXPECT_EQ(second.rows().size(), 14U) << "from the checkpoint on";
    EXPECT_EQ(second.rows().back(), whole.rows().back());
    const HistoryTable once = read_history(folder / "whole" / "history.csv", 1000);
    EXPECT_EQ(read_history(folder / "out" / "history.csv", 1000).rows, once.rows);
  }
  ashlar::Run another = make();
  EXPECT_THROW(another.resume(folder / "none"), ClaimRefused);
  ashlar::Run other(loaded(pushed_cube("end_time = 0.02, time_step = 2e-3")));
  EXPECT_THROW(other.resume(folder / "out"), CheckpointError);
}

TEST(Run, ThreadsAndLoadsHaveNumbers) {
  EXPECT_THROW(ashlar::Run(loaded(pier), 0), std::invalid_argument);
  ashlar::Run run(loaded(pier));
  for (const int load : {-1, 1})
    EXPECT_THROW(run.set_load_factor("pier", load, 2.0), std::out_of_range) << load;
}

TEST(Run, ABlockThatNothingHoldsIsNoStaticAnalysis) {
  EXPECT_THROW(ashlar::Run(loaded(pushed_cube("type = \"static\", gravity = [0, 0, 0]"))),
               std::invalid_argument);
}

/// A run that is recorded with a frame for each step, after its first step.
Run recorded(const std::filesystem::path& folder) {
  ashlar::Run run(loaded(pushed_cube("end_time = 0.02, time_step = 1e-3") + "[output]\nevery = 1\n"));
  run.record(folder);
  EXPECT_TRUE(run.step());
  return run;
}

TEST(Run, FramesDoNotGoThroughALinkThatTakesThePlaceOfTheirFolder) {
  const TemporaryFolder folder;
  ashlar::Run run = recorded(folder / "out");
  std::filesystem::rename(folder / "out/frames", folder / "moved");
  std::filesystem::create_directory(folder / "elsewhere");
  std::filesystem::create_directory_symlink(folder / "elsewhere", folder / "out/frames");
  EXPECT_THROW((void)run.step(), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_empty(folder / "elsewhere"));
}

TEST(Run, AnotherFolderOfFramesIsNoticed) {
  const TemporaryFolder folder;
  ashlar::Run run = recorded(folder / "out");
  std::filesystem::rename(folder / "out/frames", folder / "moved");
  std::filesystem::create_directory(folder / "out/frames");
  EXPECT_THROW((void)run.step(), std::runtime_error);
}

TEST(Run, TablesThatOthersCutAreNoticed) {
  for (const char* table : {"out/history.csv", "out/contacts.csv"}) {
    const TemporaryFolder folder;
    ashlar::Run run = recorded(folder / "out");
    std::filesystem::resize_file(folder / table, 3);
    EXPECT_THROW((void)run.step(), std::runtime_error) << table;
  }
}

}  // namespace
}  // namespace ashlar::run_test
