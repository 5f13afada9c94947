#include "apps/results/folder/scene_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "apps/results/tables/history_table.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar {
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

TEST(SceneRun, ALoadChangesBetweenSteps) {
  SceneRun run(loaded(pushed_cube("end_time = 0.02, time_step = 1e-3, gravity = [0, 0, 0]")));
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

TEST(SceneRun, TheWorkOfAChangedLoadIsInTheLedger) {
  SceneRun run(loaded(pushed_cube("end_time = 0.02, time_step = 1e-3, gravity = [0, 0, 0]")));
  run.set_load_factor("cube", 0, 5.0);
  while (run.step()) {
  }
  // v = 5 * 0.02, of 2000 kg
  const double kinetic = 0.5 * 2000.0 * 0.1 * 0.1;
  const Ledger& ledger = run.simulation().ledger();
  EXPECT_NEAR(ledger.kinetic, kinetic, 1e-9 * kinetic);
  EXPECT_NEAR(ledger.residual, 0.0, 1e-9 * kinetic);
}

TEST(SceneRun, WrongLoadsChangeNothing) {
  SceneRun run(loaded(pushed_cube("end_time = 0.02, time_step = 1e-3, gravity = [0, 0, 0]")));
  EXPECT_THROW(run.set_load_factor("ball", 0, 1.0), std::out_of_range);
  EXPECT_THROW(run.set_load_factor("cube", 1, 1.0), std::out_of_range);
  EXPECT_THROW(run.set_load_factor("cube", -1, 1.0), std::out_of_range);
  EXPECT_THROW(run.set_load_factor("cube", 0, std::numeric_limits<double>::infinity()),
               std::invalid_argument);
  EXPECT_THROW((void)run.motion("ball", {0, 0, 0}), std::out_of_range);
  (void)run.step();
  EXPECT_NEAR(run.motion("cube", {0.5, 0.5, 0.5}).velocity.x(), 0.001, 1e-14);
}

TEST(SceneRun, AStaticAnalysisGoesOnUnderANewLoad) {
  SceneRun run(loaded(pier));
  for (const double factor : {1.0, 2.0, 0.5}) {
    run.set_load_factor("pier", 0, factor);
    while (run.step()) {
    }
    EXPECT_EQ(run.status(), RunStatus::equilibrium);
    const double expected = -(factor * 1e5 + 2000.0 * 10.0 * 1.0);
    EXPECT_NEAR(run.motion("pier", {0.5, 0.5, 1.0}).stress(2, 2), expected, 1e-3 * std::abs(expected));
  }
}

TEST(SceneRun, WhatIsTooMuchMoves) {
  std::string pushed = pier;
  pushed.insert(pushed.rfind(']'), ", { point = [0, 0.5, 0], force = [1, 0, 0] }");
  SceneRun run(loaded(pushed));
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

TEST(SceneRun, StagesFollowEachOther) {
  SceneRun run(loaded(pier + R"(
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

TEST(SceneRun, PointsThatAreNotOfABlockAreRefused) {
  const SceneRun run(loaded(pier));
  EXPECT_EQ(run.motion("pier", {1.0, 1.0, 2.0}).place, Vector3(1.0, 1.0, 2.0)) << "a corner is of the block";
  EXPECT_THROW((void)run.motion("pier", {0.5, 0.5, 2.5}), std::domain_error);
  EXPECT_NO_THROW((void)run.motion("pier", {0.5, 0.5, 2.5}, OutsidePoints::extrapolated));
  EXPECT_THROW((void)run.motion("pillar", {0.5, 0.5, 1.0}), std::out_of_range);
}

TEST(SceneRun, WritesAndRecordsTheSameHistory) {
  const TemporaryFolder folder;
  SceneRun run(loaded(pushed_cube("end_time = 0.02, time_step = 1e-3, gravity = [0, 0, 0]")));
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
  SceneRun another(loaded(pushed_cube("end_time = 0.02, time_step = 1e-3, gravity = [0, 0, 0]")));
  EXPECT_THROW(another.record(folder / "written"), ClaimRefused);
  // One recording at a time, and none of what is over.
  another.record(folder / "other");
  EXPECT_THROW(another.record(folder / "third"), std::logic_error);
  EXPECT_THROW(run.record(folder / "third"), std::logic_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "third"));
}

TEST(SceneRun, ASearchForAFactorIsNoRun) {
  for (const char* type : {"factor-of-safety", "capacity"}) {
    std::string search = pier;
    const std::string kind = "\"static\"";
    search.replace(search.find(kind), kind.size(), std::string(1, '"').append(type) + '"');
    EXPECT_THROW(SceneRun(loaded(search)), std::invalid_argument) << type;
  }
}

TEST(SceneRun, ThreadsAndLoadsHaveNumbers) {
  EXPECT_THROW(SceneRun(loaded(pier), 0), std::invalid_argument);
  SceneRun run(loaded(pier));
  for (const int load : {-1, 1})
    EXPECT_THROW(run.set_load_factor("pier", load, 2.0), std::out_of_range) << load;
}

TEST(SceneRun, ABlockThatNothingHoldsIsNoStaticAnalysis) {
  EXPECT_THROW(SceneRun(loaded(pushed_cube("type = \"static\", gravity = [0, 0, 0]"))),
               std::invalid_argument);
}

/// A run that is recorded with a frame for each step, after its first step.
SceneRun recorded(const std::filesystem::path& folder) {
  SceneRun run(loaded(pushed_cube("end_time = 0.02, time_step = 1e-3") + "[output]\nevery = 1\n"));
  run.record(folder);
  EXPECT_TRUE(run.step());
  return run;
}

TEST(SceneRun, FramesDoNotGoThroughALinkThatTakesThePlaceOfTheirFolder) {
  const TemporaryFolder folder;
  SceneRun run = recorded(folder / "out");
  std::filesystem::rename(folder / "out/frames", folder / "moved");
  std::filesystem::create_directory(folder / "elsewhere");
  std::filesystem::create_directory_symlink(folder / "elsewhere", folder / "out/frames");
  EXPECT_THROW((void)run.step(), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_empty(folder / "elsewhere"));
}

TEST(SceneRun, AnotherFolderOfFramesIsNoticed) {
  const TemporaryFolder folder;
  SceneRun run = recorded(folder / "out");
  std::filesystem::rename(folder / "out/frames", folder / "moved");
  std::filesystem::create_directory(folder / "out/frames");
  EXPECT_THROW((void)run.step(), std::runtime_error);
}

TEST(SceneRun, TablesThatOthersCutAreNoticed) {
  for (const char* table : {"out/history.csv", "out/contacts.csv"}) {
    const TemporaryFolder folder;
    SceneRun run = recorded(folder / "out");
    std::filesystem::resize_file(folder / table, 3);
    EXPECT_THROW((void)run.step(), std::runtime_error) << table;
  }
}

}  // namespace
}  // namespace ashlar
