// Histories of supports as users write them, and their messages.
#include "apps/scene/check/warnings/base_motion.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "apps/scene/assemble/build_simulation.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/run_fixture.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::base_motion_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

const std::string point = "point = [0, 0, 0]\n";

TEST(BaseMotion, HistoriesAreHeldToTheirRules) {
  EXPECT_THAT(
      reading_faults(sample_with(22, point + "acceleration_history = [[-1, 0, 0, 0], [1, 0, 1, 0]]")),
      ElementsAre("s.toml:23:24: error: acceleration_history begins before t = 0, where the block is at rest "
                  "(-1), times of at least 0 are needed"));
  EXPECT_THAT(
      reading_faults(sample_with(22, point + "velocity_history = [[0, 0, 0, 0]]\n"
                                             "displacement_history = [[0, 0, 0, 0]]")),
      ElementsAre(HasSubstr("a support has 2 histories (displacement_history, velocity_history), at most one "
                            "is allowed")));
  EXPECT_THAT(
      reading_faults(sample_with(22, point + "interpolation = \"cubic\"")),
      ElementsAre(
          "s.toml:23:1: error: interpolation without displacement_history (no history), it is that of "
          "displacements"));
  EXPECT_THAT(
      reading_faults(sample_with(
          22, point + "components = [\"x\"]\nacceleration_history = [[0, 1, 2, 0], [1, 0, 0, 0]]")),
      ElementsAre(
          "s.toml:24:24: error: acceleration_history moves a component that is not held (ay = 2 at t = "
          "0), 0 or \"y\" among components is needed"));
  EXPECT_THAT(
      reading_faults(sample_with(22, point + "velocity_history = [[0, 0, 0, 0], [1e-300, 1e10, 0, 0]]")),
      ElementsAre(HasSubstr("velocity_history leads to numbers that are not finite")));
  EXPECT_THAT(reading_faults(sample_with(22, point + "velocity_history = [[0, 1, 0, 0]]")), IsEmpty());
}

std::vector<std::string> warnings_of(const std::string& history,
                                     const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  write_text(folder / "s.toml", sample_with(22, point + history));
  Diagnostics diagnostics;
  EXPECT_TRUE(load_scene(folder / "s.toml", overrides, diagnostics));
  std::vector<std::string> result;
  for (const std::string& line : printed(diagnostics)) result.push_back(line.substr(line.find("s.toml:")));
  return result;
}

TEST(BaseMotion, JumpsOfVelocityBetweenRowsAreWarnedOf) {
  // u = t^2 on rows 0.1 s apart: the slope jumps by 0.2 m/s at each row, 20 m/s^2 in a step of 0.01 s, 40 in
  // one of 0.005 s; the last row stops from 1.9 m/s.
  std::string rows = "[0, 0, 0, 0]";
  for (int k = 1; k <= 10; ++k) rows += fmt::format(", [{:.1f}, {:.2f}, 0, 0]", 0.1 * k, 0.01 * k * k);
  const std::string history = "displacement_history = [" + rows + "]";
  EXPECT_THAT(warnings_of(history, {"analysis.time_step=0.0005"}),
              ElementsAre(StartsWith(
                  "s.toml:23:24: warning: displacement_history is linear between rows 0.1 s apart: "
                  "the velocity jumps by 0.2 m/s at t = 0")));
  EXPECT_THAT(warnings_of(history, {"analysis.time_step=0.1"}), IsEmpty());
  EXPECT_THAT(warnings_of(history + "\ninterpolation = \"cubic\"", {"analysis.time_step=0.0005"}), IsEmpty());
  EXPECT_THAT(warnings_of(history, {"analysis.time_step=0.0005", "analysis.type=static"}), IsEmpty());
}

TEST(BaseMotion, WhatRecordsLeaveIsTold) {
  const TemporaryFolder folder;
  write_text(folder / "s.toml",
             sample_with(22, point + "acceleration_history = [[0, 1, 0, 0], [0.5, 1, 0, 0]]"));
  Diagnostics diagnostics;
  const auto loaded = load_scene(folder / "s.toml", {}, diagnostics);
  ASSERT_TRUE(loaded);
  EXPECT_THAT(
      motion_left(loaded->scene),
      ElementsAre(
          "left at the end of acceleration_history of block \"B\" (t = 0.5 s): displacement [0.125, 0, "
          "0] m, velocity [0.5, 0, 0] m/s"));
}

/// The name of the base of a scene of blocks A, B, ... with these supports, "none" if there is none.
std::string base_with(const std::vector<std::string>& supports, const std::string& more = "") {
  std::string text =
      "[analysis]\nend_time = 1\ntime_step = 0.1\n[[material]]\nname = \"rock\"\ndensity = 2500\n"
      "young_modulus = 1e9\npoisson_ratio = 0.2\n";
  for (std::size_t k = 0; k < supports.size(); ++k)
    text += fmt::format(
        "[[block]]\nname = \"{}\"\nmaterial = \"rock\"\nbox = {{ min = [{}, 0, 0], max = [{}, 1, 1] }}\n{}\n",
        static_cast<char>('A' + k), 2 * k, 2 * k + 1, supports[k]);
  const TemporaryFolder folder;
  write_text(folder / "s.toml", text + more);
  Diagnostics diagnostics;
  const auto loaded = load_scene(folder / "s.toml", {}, diagnostics);
  if (!loaded) return printed(diagnostics).front();
  const auto base = moved_base(loaded->scene);
  return base ? loaded->scene.block[*base].name : "none";
}

TEST(BaseMotion, TheBaseIsTheBlockThatHistoriesMove) {
  const auto fix = [](int block, const std::string& history) {
    return fmt::format("fix = [{{ plane = {{ point = [{}, 0, 0], normal = [0, 0, 1] }}{} }}]", 2 * block,
                       history);
  };
  const std::string push = ", displacement_history = [[0, 0, 0, 0], [1, 0.1, 0, 0]]";
  const std::string shake = ", acceleration_history = [[0, 0, 0, 0], [1, 1, 0, 0]]";
  const std::string still = ", velocity_history = [[0, 0, 0, 0], [1, 0, 0, 0]]";
  EXPECT_EQ(base_with({"", ""}), "none");
  EXPECT_EQ(base_with({"", fix(1, push), ""}), "B");
  EXPECT_EQ(base_with({fix(0, shake), "", fix(2, shake)}), "A") << "the same motion";
  EXPECT_EQ(base_with({fix(0, shake), fix(1, push)}), "none") << "two motions";
  EXPECT_EQ(base_with({"fixed = true", fix(1, push)}), "none")
      << "what is pushed while others are held is no base";
  EXPECT_EQ(base_with({fix(0, ""), fix(1, push)}), "none") << "held by a support at rest";
  EXPECT_EQ(base_with({fix(0, still), fix(1, push)}), "none") << "a history of zeros is at rest";
  const std::string assigned = "[[assign]]\nblocks = [\"B\"]\nfixed = true\n";
  EXPECT_EQ(base_with({fix(0, push), ""}, assigned), "none") << "fixed by an assignment";
  const std::string stage =
      "[[stage]]\nname = \"build\"\n[[stage]]\nname = \"shake\"\n[[stage.fix]]\nblocks = [\"B\"]\n"
      "plane = { point = [2, 0, 0], normal = [0, 0, 1] }\n" +
      shake.substr(2) + "\n";
  EXPECT_EQ(base_with({"", ""}, stage), "B") << "moved in a stage";
}

// A slab that is carried along by both of its faces.
std::string slab(const std::string& history) {
  std::string text = R"([analysis]
end_time = 0.05
time_step = 1e-3
[[material]]
name = "rock"
density = 2500
young_modulus = 1e10
poisson_ratio = 0.2
[[block]]
name = "base"
material = "rock"
box = { min = [-1, -1, -0.3], max = [1, 1, 0] }
[[measure]]
name = "base"
block = "base"
point = [0, 0, 0]
)";
  std::string fixes;
  for (const char* z : {"-0.3", "0"})
    fixes +=
        fmt::format("[[block.fix]]\nplane = {{ point = [0, 0, {}], normal = [0, 0, 1] }}\n{}\n", z, history);
  text.insert(text.find("[[measure]]"), fixes);
  return text;
}

TEST_F(RunCommand, ABaseHasTheAccelerationOfItsRecordFromAFile) {
  write_text(folder_ / "record.csv",
             "# a record\nt; up ; across\n0;0;0\n0.02;1;-0.5\r\n\n0.04;0.25;0\n0.05;0;0\n");
  write_text(scene_,
             slab("acceleration_history = { file = \"record.csv\", time = \"t\", values = [\"across\", \"\", "
                  "\"up\"], scale = 10 }"));
  ASSERT_EQ(run("out"), 0) << faults_;
  const std::vector<double> t = column("out/history.csv", "time");
  const std::vector<double> vx = column("out/history.csv", "base.vx"),
                            vz = column("out/history.csv", "base.vz");
  ASSERT_GT(t.size(), 50U);
  const auto across = [](double time) {
    return time < 0.02 ? -5.0 * time / 0.02 : time < 0.04 ? -5.0 * (0.04 - time) / 0.02 : 0.0;
  };
  for (std::size_t k = 1; k <= 50; ++k) {
    const double step = t[k] - t[k - 1];
    EXPECT_NEAR((vx[k] - vx[k - 1]) / step, across(0.5 * (t[k] + t[k - 1])), 1e-9);
  }
  EXPECT_NEAR(vz[20], 0.5 * 0.02 * 10.0, 1e-12);
  const auto summary = text("out/summary.json");
  EXPECT_THAT(summary, HasSubstr("record.csv"));
}

TEST_F(RunCommand, AChangedRecordIsAnotherScene) {
  write_text(folder_ / "r.csv", "t,a\n0,1\n1,1\n");
  write_text(scene_,
             slab("acceleration_history = { file = \"r.csv\", time = \"t\", values = [\"a\", \"\", \"\"] }"));
  ASSERT_EQ(run("out"), 0) << faults_;
  write_text(folder_ / "r.csv", "t,a\n0,1\n1,2\n");
  EXPECT_EQ(run("out", {"--resume"}), 2);
  write_text(folder_ / "r.csv", "t,a\n0,1\n1,1\n");
  EXPECT_EQ(run("out", {"--resume"}), 0) << faults_;
}

TEST_F(RunCommand, LoadsFollowAFile) {
  write_text(folder_ / "load.csv", "t,f\n0,0\n1,1\n");
  std::string scene = slab("");
  scene.insert(scene.find("[[measure]]"),
               "[[block.load]]\npoint = [0, 0, 0]\nforce = [0, 0, -1]\n"
               "history = { file = \"load.csv\", time = \"t\", values = [\"f\"] }\n");
  write_text(scene_, scene);
  EXPECT_EQ(command({"check", scene_.string()}), 0) << faults_;
  write_text(folder_ / "load.csv", "t,f\n0,0\n1,1,2\n2,\n");
  EXPECT_EQ(command({"check", scene_.string()}), 2);
  EXPECT_THAT(faults_, HasSubstr("load.csv:4:3: error: no number (\"\"), a finite number is needed"));
}

TEST_F(RunCommand, FaultsOfRecordsHaveTheirPlace) {
  const std::string history =
      "acceleration_history = { file = \"r.csv\", time = \"t\", values = [\"a\", \"\", \"\"] }";
  write_text(scene_, slab(history));
  EXPECT_EQ(command({"check", scene_.string()}), 2);
  EXPECT_THAT(faults_, HasSubstr("there is no such file"));
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "r.csv:1:1: error: record is empty (no line of column names), columns \"t\", \"a\" are needed"},
      {"t,b\n0,1\n", "r.csv:1:1: error: record has no column \"a\" (t, b), columns \"t\", \"a\" are needed"},
      {"t,a\n", "error: record has no rows (0), at least 1 is needed"},
      {"t,a\n0,1\n0,2\n", "r.csv:3:1: error: time does not increase (0 after 0)"},
      {"t,a\n0\n", "r.csv:2:2: error: row has 1 fields, at least 2 are needed"},
      {"t,a\n0,1,5\n", "r.csv:2:5: error: row has 3 fields, the header has 2"},
      {"t,a,a\n0,1,2\n", "r.csv:1:1: error: record has several columns \"a\" (2), one is needed"},
      {"t,a,t\n0,1,2\n", "r.csv:1:1: error: record has several columns \"t\" (2), one is needed"},
      {"t,a\n0, 1e999\n", "r.csv:2:4: error: no number (\"1e999\"), a finite number is needed"},
      {"t,a\n0, nan\n", "r.csv:2:4: error: no number (\"nan\"), a finite number is needed"},
      {"t,a\n0,+-1\n", "r.csv:2:3: error: no number (\"+-1\"), a finite number is needed"},
      {"t,a\n0,++1\n", "r.csv:2:3: error: no number (\"++1\"), a finite number is needed"},
      {"t,a\r0,1\r1,2\r",
       "r.csv:1:4: error: lines are ended by carriage returns alone (byte 13), line feeds, or both together, "
       "are "
       "needed"},
      {"t,a\r\n0,1\r1,2\r\n", "r.csv:2:4: error: lines are ended by carriage returns alone (byte 13)"},
      {"PEER NGA STRONG MOTION DATABASE RECORD\nA SINE\nACCELERATION TIME SERIES IN UNITS OF G\n",
       "r.csv:3:1: error: PEER record ends in its head (3 lines); 4 lines and values are needed"},
      {"t;a\n0;1,5\n",
       "r.csv:2:3: error: no number (\"1,5\"), a finite number with a decimal point, not a comma, is"}};
  for (const auto& [content, fault] : cases) {
    write_text(folder_ / "r.csv", content);
    EXPECT_EQ(command({"check", scene_.string()}), 2) << content;
    EXPECT_THAT(faults_, HasSubstr(fault)) << content;
  }
  std::string many = "t,a\n";
  for (int k = 0; k < 1000; ++k) many += "x,y\n";
  write_text(folder_ / "r.csv", many);
  EXPECT_EQ(command({"check", scene_.string()}), 2);
  EXPECT_THAT(faults_, HasSubstr("record has 1000 faults in all, the first 20 are listed"));
  EXPECT_LT(faults_.size(), 10'000U);
}

}  // namespace
}  // namespace ashlar::test::base_motion_test
