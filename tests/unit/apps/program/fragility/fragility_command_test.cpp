// `ashlar fragility`.
#include "apps/program/fragility/fragility_command.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/program/sweep/run_processes.hpp"
#include "apps/results/text/csv_text.hpp"
#include "unit/apps/run_fixture.hpp"

namespace ashlar::fragility_command_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// A table that records move, and a cube that falls freely beside it: 0.049 m in the 0.1 s of a record.
constexpr const char* table_text = R"([analysis]
end_time = 0.1
time_step = 1e-3
[contact]
friction_angle = 30
[[block]]
name = "table"
material = "rock"
box = { min = [-1, -1, -0.2], max = [1, 1, 0] }
[[block.fix]]
plane = { point = [0, 0, 0], normal = [0, 0, 1] }
acceleration_history = { file = "any.csv", time = "t", values = ["a", "", ""] }
[[block.fix]]
plane = { point = [0, 0, -0.2], normal = [0, 0, 1] }
acceleration_history = { file = "any.csv", time = "t", values = ["a", "", ""] }
[[block]]
name = "cube"
material = "rock"
order = 0
box = { min = [5, 0, 0], max = [6, 1, 1] }
[[measure]]
name = "table"
block = "table"
point = [0, 0, 0]
)";

class Fragility : public RunCommand {
 protected:
  /// Records of 1 and 2 m/s^2 for 0.1 s.
  Fragility() {
    write_text(scene_, std::string(table_text) + rock_text);
    std::filesystem::create_directory(records_);
    write_text(records_ / "a.csv", "t,a\n0,1\n0.1,1\n");
    write_text(records_ / "b.csv", "t,a\n0,2\n0.1,2\n");
  }

  int fragility(std::vector<std::string> more, const std::string& out = "f",
                const std::string& scales = "1:1:4") {
    std::vector<std::string> arguments = {"fragility", scene_.string(),
                                          "--records", records_.string(),
                                          "--scales",  scales,
                                          "--after",   "0",
                                          "-o",        (folder_ / out).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return command(std::move(arguments));
  }

  [[nodiscard]] nlohmann::json result(const std::string& out = "f") const {
    return nlohmann::json::parse(text(out + "/fragility.json"));
  }

  /// A column of numbers of the table.
  [[nodiscard]] std::vector<double> numbers(const std::string& name) const {
    const std::vector<std::string> table = lines("f/fragility.csv"), names = split_csv_line(table.at(0));
    const auto place = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    std::vector<double> values;
    for (std::size_t k = 1; k < table.size(); ++k)
      values.push_back(std::stod(split_csv_line(table[k]).at(place)));
    return values;
  }

  std::filesystem::path records_ = folder_ / "records";
};

// The table moves a s t^2 / 2 by the acceleration a of the record times its scale s: 0.005 a s at the end.
TEST_F(Fragility, ARunExceedsALimitWhereItsMotionDoes) {
  ASSERT_EQ(fragility({"--limit", "table.ux > 0.0151", "-j", "2"}), 0) << faults_;
  EXPECT_EQ(lines("f/fragility.csv").size(), 9U);
  EXPECT_EQ(lines("f/fragility.csv").front(),
            "record,scale,pga,folder,status,time,collapse,block,table.ux,table.ux > 0.0151");
  const auto number = [&](const std::string& name, int row) {
    return numbers(name).at(static_cast<std::size_t>(row));
  };
  for (int row = 0; row < 8; ++row) {
    const double a = row < 4 ? 1.0 : 2.0, s = 1.0 + row % 4;
    EXPECT_THAT(lines("f/fragility.csv")[static_cast<std::size_t>(row + 1)],
                StartsWith(row < 4 ? "a.csv," : "b.csv,"));
    EXPECT_DOUBLE_EQ(number("scale", row), s);
    EXPECT_DOUBLE_EQ(number("pga", row), a * s);
    const bool exceeds = 0.005 * a * s > 0.0151;
    EXPECT_EQ(number("table.ux > 0.0151", row), exceeds ? 1.0 : 0.0);
    // A run ends with the step that exceeds the limit.
    const double end = exceeds ? 1e-3 * std::ceil(std::sqrt(2.0 * 0.0151 / (a * s)) / 1e-3) : 0.1;
    EXPECT_NEAR(number("time", row), end, 1e-9);
    EXPECT_NEAR(number("table.ux", row), 0.5 * a * s * end * end, 1e-9);
  }
  // Motions that exceed it have 4 m/s^2 or more, the others 3 or less.
  EXPECT_THAT(printed_, HasSubstr("table.ux > 0.0151: median between 3 and 4 m/s^2"));
  EXPECT_EQ(result()["fit"], "separated");
  EXPECT_NEAR(result()["median"].get<double>(), std::sqrt(12.0), 1e-9);
  EXPECT_NEAR(result()["median_in_g"].get<double>(), std::sqrt(12.0) / 9.80665, 1e-9);
  EXPECT_TRUE(result()["dispersion"].is_null());
  EXPECT_EQ(result()["limits"][0]["exceeded"], 4);
  EXPECT_THAT(faults_, AllOf(HasSubstr("8 of 8: "), HasSubstr("table: ")));
}

TEST_F(Fragility, PicturesAreDrawnByScriptsThatHoldTheRuns) {
  ASSERT_EQ(fragility({"--limit", "table.ux > 0.0151", "-q"}, "f", "1,4"), 0) << faults_;
  EXPECT_THAT(text("f/fragility.py"), HasSubstr("table.ux > 0.0151, share of runs"));
  // The line of record a.csv has its two runs.
  EXPECT_THAT(text("f/ida.py"), AllOf(HasSubstr("a.csv"), HasSubstr(R"(\"y\":[1.0,4.0])")));
}

TEST_F(Fragility, ARepeatedCommandKeepsRuns) {
  ASSERT_EQ(fragility({"--limit", "table.ux > 0.0151"}, "f", "1,4"), 0) << faults_;
  const std::string table = text("f/fragility.csv");
  const auto written = [&](const char* scale) {
    return std::filesystem::last_write_time(folder_ / "f/runs" /
                                            (std::string("record=a.csv,scale=") + scale) / "summary.json");
  };
  const auto before = written("4"), of_survivor = written("1");
  ASSERT_EQ(fragility({"--limit", "table.ux > 0.0151"}, "f", "1,4"), 0) << faults_;
  EXPECT_EQ(text("f/fragility.csv"), table);
  EXPECT_EQ(written("4"), before) << "a run that was ended early";
  EXPECT_EQ(written("1"), of_survivor);
  // As a stopped analysis leaves runs: without a summary, without an outcome.
  std::filesystem::remove(folder_ / "f/runs/record=a.csv,scale=4/summary.json");
  std::filesystem::remove(folder_ / "f/runs/record=a.csv,scale=1.outcome.json");
  std::filesystem::remove_all(folder_ / "f/runs/record=b.csv,scale=4");
  ASSERT_EQ(fragility({"--limit", "table.ux > 0.0151"}, "f", "1,4"), 0) << faults_;
  EXPECT_EQ(text("f/fragility.csv"), table);
}

TEST_F(Fragility, RunsGoOnForAnotherLimit) {
  ASSERT_EQ(fragility({"--limit", "table.ux > 0.0151"}, "f", "2,4"), 0) << faults_;
  ASSERT_EQ(fragility({"--limit", "table.ux > 0.0251", "--limit", "table.ux > 0.0151"}, "f", "2,4"), 0)
      << faults_;
  ASSERT_EQ(fragility({"--limit", "table.ux > 0.0251", "--limit", "table.ux > 0.0151"}, "g", "2,4"), 0)
      << faults_;
  const std::vector<std::string> one = lines("f/fragility.csv"), other = lines("g/fragility.csv");
  EXPECT_EQ(one, other);
  EXPECT_EQ(result()["limits"][0]["exceeded"], 1);
  EXPECT_EQ(result()["limits"][1]["exceeded"], 3);
}

TEST_F(Fragility, ACollapseExceedsAllLimits) {
  // In a record of 0.4 s the cube falls more than half of its size: at sqrt(2 0.5 / 9.81) = 0.3193 s.
  write_text(records_ / "a.csv", "t,a\n0,1\n0.4,1\n");
  write_text(records_ / "b.csv", "t,a\n0,2\n0.2,2\n");
  ASSERT_EQ(fragility({"--limit", "table.ux > 9", "--limit", "collapse"}, "f", "1,2"), 0) << faults_;
  EXPECT_THAT(lines("f/fragility.csv")[1], HasSubstr(",collapsed,0.32"));
  EXPECT_THAT(lines("f/fragility.csv")[1], AllOf(HasSubstr(",1,cube,"), ::testing::EndsWith(",1")));
  EXPECT_THAT(lines("f/fragility.csv")[3], AllOf(HasSubstr(",moving,"), ::testing::EndsWith(",0")));
  EXPECT_EQ(result()["limits"][0]["exceeded"], 2);
  EXPECT_EQ(result()["limits"][1]["exceeded"], 2);
  EXPECT_EQ(result()["limits"][0]["moving_at_end"], 2);
}

TEST_F(Fragility, SamplesAreRunWithEachRecordAndScale) {
  // The scale of samples does not matter to the motion; the density is drawn.
  ASSERT_EQ(fragility({"--limit", "table.ux > 0.0151", "--vary", "material.0.density=uniform(1000,3000)",
                       "--samples", "2", "--seed", "5"},
                      "f", "3,4"),
            0)
      << faults_;
  EXPECT_EQ(lines("f/fragility.csv").size(), 9U);
  EXPECT_THAT(lines("f/fragility.csv").front(), StartsWith("record,scale,material.0.density,pga,"));
  const std::vector<double> density = numbers("material.0.density");
  EXPECT_NE(density[0], density[1]);
  EXPECT_EQ(density[0], density[2]) << "the same samples at each scale";
}

TEST_F(Fragility, BadInputIsTold) {
  const auto refusal = [&](std::vector<std::string> more, const std::string& words,
                           const std::string& scales = "1") {
    EXPECT_EQ(fragility(std::move(more), "f", scales), exit_status::bad_input);
    EXPECT_THAT(faults_, HasSubstr(words));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "f"));
  };
  refusal({"--limit", "table.uq > 1"},
          "no column of history.csv has that name (table.uq), did you mean table.u");
  refusal({"--limit", "collapse", "--limit", "collapse"}, "--limit is given twice (collapse)");
  refusal({"--intensity", "pgv"}, "--intensity is no measure of intensity (pgv)");
  refusal({"--vary", "material.0.density=1,2"}, "a random value is needed");
  refusal({}, "step is not above 0 (0)", "1:0:2");
  refusal({}, "last scale is below the first (1 and 2)", "2:1:1");
  refusal({}, "range has 2 numbers", "1:2");
  refusal({}, "a scale is not above 0 (0)", "0,1");
  refusal({}, "a scale is given twice (1)", "1,2,1");
  refusal({}, "not a list of numbers", "much");
  records_ = folder_ / "none";
  refusal({}, "there is no such folder, a folder of records is needed");
  std::filesystem::create_directory(folder_ / "empty");
  records_ = folder_ / "empty";
  refusal({}, "the folder has no records, files named *.AT2");
}

TEST_F(Fragility, FaultsOfRecordsAreTold) {
  const auto refusal = [&](const std::string& words) {
    EXPECT_EQ(fragility({}, "f", "1"), exit_status::bad_input);
    EXPECT_THAT(faults_, HasSubstr(words));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "f"));
  };
  write_text(records_ / "b.csv", "t,a\n0,0\n0.1,0\n");
  refusal("b.csv:1:1: error: record is zero throughout, accelerations are needed");
  write_text(records_ / "b.csv", "t,a\n0,1\n0.1,1\n0.2,1\n0.4,1\n");
  refusal(
      "b.csv:1:1: error: steps of the record differ (2 times, at 0.4 s), equal ones are needed, or resample");
  write_text(records_ / "b.csv", "t,b\n0,1\n");
  refusal("record has no column \"a\"");
  std::filesystem::rename(records_ / "b.csv", records_ / "b.AT2");
  refusal("records have different units: a.csv has the unit of a table, by the scene's scale, b.AT2 has g");
}

TEST_F(Fragility, ScenesWithoutAPlaceForRecordsAreTold) {
  const auto refusal = [&](const std::string& scene, const std::string& words) {
    write_text(scene_, scene);
    EXPECT_EQ(fragility({}, "f", "1"), exit_status::bad_input);
    EXPECT_THAT(faults_, HasSubstr(words));
  };
  const std::string sound = text("s.toml");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = sound;
    for (std::size_t at = changed.find(from); at != std::string::npos;
         at = changed.find(from, at + to.size()))
      changed.replace(at, from.size(), to);
    return changed;
  };
  refusal(scene_text,
          "s.toml:1:1: error: scene has no base that a record moves, a support with acceleration_history = ");
  refusal(with("{ file = \"any.csv\", time = \"t\", values = [\"a\", \"\", \"\"] }",
               "[[0, 0, 0, 0], [1, 1, 0, 0]]"),
          "rows of an acceleration in the scene cannot be replaced by records");
  std::string two = sound;
  two.replace(two.find("any.csv"), 7, "one.csv");
  refusal(two, "records differ (\"one.csv\" and \"any.csv\"), one record for all supports is needed");
  refusal(with("order = 0", "fixed = true"), "no block can move (all are fixed, or moved by supports)");
  refusal(with("end_time = 0.1", "end_time = 0.1\ntype = \"static\""), "records move a scene in time only");
  refusal("[analysis\n", "s.toml:1:");
}

TEST_F(Fragility, AnotherTableIsNotReplaced) {
  std::filesystem::create_directory(folder_ / "f");
  write_text(folder_ / "f/fragility.csv", "my own notes\n");
  EXPECT_EQ(fragility({}), exit_status::bad_input);
  EXPECT_EQ(text("f/fragility.csv"), "my own notes\n");
}

TEST(Scales, ARangeHasItsLastScale) {
  EXPECT_THAT(parse_scales("0.1:0.1:0.5"), ElementsAre(0.1, 0.2, 0.3, 0.4, 0.5));
  EXPECT_THAT(parse_scales("0.1:0.15:0.5"), ElementsAre(0.1, 0.25, 0.4));
  EXPECT_THAT(parse_scales("2,0.5"), ElementsAre(0.5, 2.0));
}

TEST(WaitingTime, HasTwoUnitsAtMost) {
  EXPECT_EQ(waiting_time(0.2), "1 s");
  EXPECT_EQ(waiting_time(119.5), "120 s");
  EXPECT_EQ(waiting_time(125.0), "2 min");
  EXPECT_EQ(waiting_time(3599.0), "1 h 0 min");
  EXPECT_EQ(waiting_time(12000.0), "3 h 20 min");
}

}  // namespace
}  // namespace ashlar::fragility_command_test
