// `ashlar sweep`.
#include "apps/program/sweep/sweep_command.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "apps/program/sweep/sweep_table.hpp"
#include "apps/program/sweep/variants.hpp"
#include "unit/apps/run_fixture.hpp"

namespace ashlar::sweep_command_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Sweep : public RunCommand {
 protected:
  /// A cube that falls, its middle measured.
  Sweep() {
    write_text(scene_, R"([analysis]
end_time = 0.1
time_step = 1e-2
[[material]]
name = "rock"
density = 2000
young_modulus = 1e9
poisson_ratio = 0.2
[[block]]
name = "cube"
material = "rock"
box = { min = [0, 0, 0], max = [1, 1, 1] }
[[measure]]
name = "middle"
block = "cube"
point = [0.5, 0.5, 0.5]
)");
  }

  int sweep(std::vector<std::string> more) {
    std::vector<std::string> arguments = {"sweep", scene_.string(), "-o", (folder_ / "t.csv").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return command(std::move(arguments));
  }

  [[nodiscard]] std::filesystem::path runs() const { return folder_ / "t.runs"; }
};

TEST_F(Sweep, AnEntryOfAListGoesByATextOfIt) {
  // The distance of contact is a thousandth of the smallest block.
  ASSERT_EQ(sweep({"--vary", "analysis.end_time=0.1", "--value", "automatic.contact.distance.value"}), 0);
  EXPECT_EQ(lines("t.csv").at(1).substr(lines("t.csv").at(1).rfind(',') + 1), "0.001");
  ASSERT_EQ(
      sweep({"--vary", "analysis.end_time=0.1", "--value", "automatic.contact.distances.value", "--force"}),
      0);
  EXPECT_THAT(faults_, HasSubstr("no run has a number of that name (automatic.contact.distances.value)"));
}

TEST_F(Sweep, ARowForEachRunWithWhatCameOfIt) {
  ASSERT_EQ(sweep({"--vary", "analysis.end_time=0.1,0.2,-1", "--value", "middle.uz", "-j", "2"}), 2);
  const std::vector<std::string> table = lines("t.csv");
  ASSERT_EQ(table.size(), 4U);
  EXPECT_EQ(table[0], "analysis.end_time,folder,status,middle.uz");
  EXPECT_THAT(table[1], StartsWith("0.1,t.runs/analysis.end_time=0.1,completed,"));
  // g t^2 / 2, exact with constant steps.
  EXPECT_NEAR(std::stod(table[1].substr(table[1].rfind(',') + 1)), -0.04905, 1e-12);
  EXPECT_NEAR(std::stod(table[2].substr(table[2].rfind(',') + 1)), -0.1962, 1e-12);
  EXPECT_EQ(table[3], "-1,t.runs/analysis.end_time=-1,refused,");
  EXPECT_EQ(printed_, text("t.csv"));
  EXPECT_THAT(faults_, AllOf(HasSubstr("3 of 3"), HasSubstr("end_time=-1: refused, see ")));
  EXPECT_THAT(text("t.runs/analysis.end_time=-1.log"), HasSubstr("end_time is out of range"));
}

TEST_F(Sweep, WhatWasNotBegunIsNotRefused) {
  const std::vector<VariedKey> keys = {parse_varied_key("a=1,2,3")};
  std::vector<std::filesystem::path> folders;
  for (const Variant& variant : variants_of(keys)) folders.push_back(runs() / variant.folder);
  std::filesystem::create_directories(folders[1]);
  write_text(folders[1].string() + ".log", "");
  write_text(folders[1] / ".ashlar", "");
  write_text(folders[2].string() + ".log", "");
  const SweepTable table = sweep_table(keys, variants_of(keys), folders, {});
  std::vector<std::string> found;
  for (const auto& row : table.rows) found.push_back(row[2]);
  EXPECT_EQ(found, (std::vector<std::string>{"not run", "interrupted", "refused"}));
}

TEST_F(Sweep, UsualValuesAreTimeAndMeasures) {
  ASSERT_EQ(sweep({"--vary", "material.0.density=1000,2000", "-q", "--set", "analysis.end_time=0.05"}), 0)
      << faults_;
  EXPECT_EQ(faults_, "");
  EXPECT_THAT(lines("t.csv").at(0), StartsWith("material.0.density,folder,status,time,middle.x,middle.y,"));
  EXPECT_THAT(lines("t.csv").at(1), HasSubstr("completed,0.05,"));
}

TEST_F(Sweep, APictureWithoutAFolderIsRefusedBeforeTheRuns) {
  EXPECT_EQ(
      sweep({"--vary", "contact.friction_angle=20,30", "--picture", (folder_ / "no" / "p.svg").string()}),
      exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("its folder does not exist"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "t.csv"));
}

TEST_F(Sweep, DrawsOneValueAgainstTheKeys) {
  const std::filesystem::path picture = folder_ / "p.svg";
  ASSERT_EQ(sweep({"--vary", "contact.friction_angle=20,30", "--vary", "analysis.end_time=0.1,0.2", "--value",
                   "middle.z", "--picture", picture.string()}),
            exit_status::done)
      << faults_;
  if (faults_.find("no picture: ") != std::string::npos) GTEST_SKIP() << faults_;
  // A line for each of the two times. The cube falls g t^2 / 2 in t.
  const std::string svg = read_text(picture);
  EXPECT_THAT(svg, AllOf(HasSubstr(">contact.friction_angle<"), HasSubstr(">middle.z<"),
                         HasSubstr(">end_time = 0.1<"), HasSubstr(">end_time = 0.2<"), HasSubstr(">20<")));
  // Two points on each line.
  EXPECT_THAT(read_text(folder_ / "p.py"), HasSubstr(R"(\"x\":[20.0,30.0])"));
  EXPECT_EQ(sweep({"--vary", "material.rock.elasticity=linear", "--picture", picture.string()}),
            exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("one such key is needed"));
  EXPECT_EQ(sweep({"--vary", "contact.friction_angle=20", "--picture", "p.jpg"}), exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("use .svg or .png"));
}

TEST_F(Sweep, SamplesHaveStatisticsAndAHistogram) {
  // Way fallen in t seconds: g t^2 / 2, of 0.1 to 0.2 s between 0.04905 and 0.1962 m.
  ASSERT_EQ(sweep({"--vary", "analysis.end_time=uniform(0.1,0.2)", "--samples", "5", "--seed", "3", "--value",
                   "middle.uz", "--picture", (folder_ / "p.svg").string()}),
            0)
      << faults_;
  const std::vector<std::string> table = lines("t.csv");
  ASSERT_EQ(table.size(), 6U);
  double mean = 0.0;
  for (std::size_t k = 1; k < table.size(); ++k) {
    const double time = std::stod(table[k]);
    EXPECT_GE(time, 0.1);
    EXPECT_LE(time, 0.2);
    const double displacement = std::stod(table[k].substr(table[k].rfind(',') + 1));
    EXPECT_NEAR(displacement, -0.5 * 9.81 * time * time, 1e-9);
    mean += displacement / 5.0;
  }
  EXPECT_THAT(faults_, HasSubstr(fmt::format("middle.uz: 5 samples, mean {:.4g}", mean)));
  EXPECT_THAT(text("p.py"), HasSubstr("5 samples"));
}

TEST_F(Sweep, TheShareOfFailuresIsThatOfFactorsBelowOne) {
  // A plate on a slope of 30 degrees stands if its friction angle is larger: each row can be checked by its key.
  write_text(scene_, std::string("analysis = { type = \"factor-of-safety\", safety = { tolerance = 0.002 } "
                                 "}\ncontact = { friction_angle = 30 }\n") +
                         rock_text + plate_text);
  ASSERT_EQ(sweep({"--vary", "contact.friction_angle=normal(31,3)", "--samples", "10"}), 0) << faults_;
  const std::vector<std::string> table = lines("t.csv");
  ASSERT_EQ(table.size(), 11U);
  int failures = 0;
  for (std::size_t k = 1; k < table.size(); ++k) {
    const double angle = std::stod(table[k]);
    ASSERT_GT(std::abs(angle - 30.0), 0.1);  // 0.4 % of the factor: no sample within its tolerance
    failures += angle < 30.0 ? 1 : 0;
  }
  ASSERT_GT(failures, 0);
  EXPECT_THAT(faults_, HasSubstr("factor_of_safety.lower: 10 samples, mean"));
  EXPECT_THAT(faults_, HasSubstr(fmt::format("{} % below 1 (", 10 * failures)));
}

TEST_F(Sweep, SamplesOfTheSameValuesAreRunOnce) {
  ASSERT_EQ(sweep({"--vary", "analysis.end_time=normal(0.1,0)", "--samples", "3", "--value", "middle.uz"}), 0)
      << faults_;
  EXPECT_EQ(lines("t.csv").size(), 4U);
  EXPECT_THAT(faults_,
              AllOf(HasSubstr("1 of 1"), HasSubstr("middle.uz: 3 samples, mean -0.04905, deviation 0")));
}

TEST_F(Sweep, FaultsOfSamplesAreTold) {
  EXPECT_EQ(sweep({"--vary", "analysis.end_time=uniform(0.1,0.2)"}), 2);
  EXPECT_THAT(faults_, HasSubstr("give --samples"));
  EXPECT_EQ(sweep({"--vary", "analysis.end_time=0.1", "--samples", "2"}), 2);
  EXPECT_THAT(faults_, HasSubstr("--samples without a random value"));
  EXPECT_EQ(sweep({"--vary", "analysis.end_time=normal(0.1)", "--samples", "2"}), 2);
  EXPECT_THAT(faults_, HasSubstr("mean and deviation"));
}

TEST_F(Sweep, IsTheRunOfItsSettings) {
  ASSERT_EQ(sweep({"--vary", "analysis.time_step=2e-2"}), 0);
  ASSERT_EQ(run("alone", {"--set", "analysis.time_step=2e-2"}), 0);
  expect_same_results("alone", "t.runs/analysis.time_step=2e-2");
}

TEST_F(Sweep, KeepsWhatHasRunAndAddsWhatIsNew) {
  ASSERT_EQ(sweep({"--vary", "analysis.end_time=0.1"}), 0);
  const auto kept = std::filesystem::last_write_time(runs() / "analysis.end_time=0.1/summary.json");
  ASSERT_EQ(sweep({"--vary", "analysis.end_time=0.1,0.2"}), 0) << faults_;
  EXPECT_EQ(lines("t.csv").size(), 3U);
  EXPECT_EQ(std::filesystem::last_write_time(runs() / "analysis.end_time=0.1/summary.json"), kept);
  EXPECT_THAT(text("t.runs/analysis.end_time=0.1.log"), HasSubstr("kept"));
  // A scene that has changed since is not accepted as the same, nor overwritten without --force.
  ASSERT_EQ(sweep({"--vary", "analysis.end_time=0.1", "--set", "material.0.density=1"}), 2);
  EXPECT_THAT(text("t.runs/analysis.end_time=0.1.log"), HasSubstr("another scene"));
  EXPECT_EQ(sweep({"--vary", "analysis.end_time=0.1", "--set", "material.0.density=1", "--force"}), 0);
}

TEST_F(Sweep, RunsAgainWhereAMeshOrTheProgramIsAnother) {
  // A tetrahedron of volume h / 6 that falls from its centroid at h / 4.
  const auto write_stone = [&](int height) {
    write_text(folder_ / "stone.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 " + std::to_string(height) +
                                          "\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  };
  std::string scene = text("s.toml");
  scene.replace(scene.find("box ="), scene.find("max") + 18 - scene.find("box ="),
                "mesh = { file = \"stone.off\" }\n");
  write_text(scene_, scene.substr(0, scene.find("[[measure]]")));
  const std::vector<std::string> options = {"--vary", "material.0.density=2000", "--value", "energy.gravity"};
  const auto energy = [&] {
    return std::stod(lines("t.csv").at(1).substr(lines("t.csv").at(1).rfind(',') + 1));
  };
  constexpr double fall = 9.81 * 0.1 * 0.1 / 2.0;

  write_stone(1);
  ASSERT_EQ(sweep(options), 0) << faults_;
  EXPECT_NEAR(energy(), 2000.0 / 6.0 * 9.81 * (0.25 - fall), 1e-6);
  write_stone(3);
  ASSERT_EQ(sweep(options), 0) << faults_;
  EXPECT_THAT(faults_, HasSubstr("(run again: mesh stone.off has changed)"));
  EXPECT_NEAR(energy(), 2000.0 / 2.0 * 9.81 * (0.75 - fall), 1e-6);
  ASSERT_EQ(sweep(options), 0) << faults_;
  EXPECT_THAT(text("t.runs/material.0.density=2000.log"), StartsWith("kept"));

  const std::filesystem::path summary = runs() / "material.0.density=2000/summary.json";
  std::string of_other = read_text(summary);
  const std::size_t identity = of_other.find("\"identity\"");
  const std::size_t version = of_other.find("\"version\": \"", identity);
  ASSERT_NE(version, std::string::npos);
  of_other.insert(version + 12, "0.");
  write_text(summary, of_other);
  ASSERT_EQ(sweep(options), 0) << faults_;
  EXPECT_THAT(faults_, HasSubstr("(run again: the program has changed (was 0."));
}

TEST_F(Sweep, LogsDoNotFollowLinks) {
  write_text(folder_ / "mine", "mine");
  std::filesystem::create_directory(runs());
  std::filesystem::create_symlink(folder_ / "mine", runs() / "analysis.end_time=0.1.log");
  EXPECT_EQ(sweep({"--vary", "analysis.end_time=0.1,0.2"}), exit_status::bad_input);
  EXPECT_THAT(
      faults_,
      HasSubstr("end_time=0.1.log: Too many levels of symbolic links; a plain file is written there"));
  EXPECT_EQ(text("mine"), "mine");
  EXPECT_THAT(lines("t.csv").at(2), HasSubstr(",completed,")) << "the other run is made";
}

TEST_F(Sweep, GoesOnWithWhatWasInterrupted) {
  ASSERT_EQ(sweep({"--vary", "analysis.end_time=0.1"}), 0);
  const std::string whole = text("t.csv");
  // As a stopped run leaves it: without its summary.
  std::filesystem::remove(runs() / "analysis.end_time=0.1/summary.json");
  ASSERT_EQ(sweep({"--vary", "analysis.end_time=0.1"}), 0) << faults_;
  EXPECT_EQ(text("t.csv"), whole);
}

TEST_F(Sweep, ForceReplacesTheStateOfAnotherSceneAndGoesOnWithItsOwn) {
  const std::filesystem::path summary = runs() / "analysis.end_time=0.1/summary.json";
  ASSERT_EQ(sweep({"--vary", "analysis.end_time=0.1"}), 0);
  const std::string whole = text("t.csv");
  std::filesystem::remove(summary);
  ASSERT_EQ(sweep({"--vary", "analysis.end_time=0.1", "--set", "material.0.density=1"}), 2) << "not unasked";
  ASSERT_EQ(sweep({"--vary", "analysis.end_time=0.1", "--force"}), 0) << faults_;
  EXPECT_EQ(text("t.csv"), whole);
  std::filesystem::remove(summary);
  ASSERT_EQ(sweep({"--vary", "analysis.end_time=0.1", "--set", "material.0.density=1", "--force"}), 0)
      << faults_;
}

// As a run leaves it that ended before its first state was saved.
TEST_F(Sweep, BeginsAgainWhereNothingWasSaved) {
  std::filesystem::create_directories(runs() / "analysis.end_time=0.1");
  write_text(runs() / "analysis.end_time=0.1/.ashlar", "");
  EXPECT_EQ(sweep({"--vary", "analysis.end_time=0.1"}), 0) << faults_;
}

TEST_F(Sweep, RefusesWhatItCannotRunOrWouldOverwrite) {
  EXPECT_EQ(sweep({"--vary", "analysis.end_time"}), 2);
  EXPECT_THAT(faults_, HasSubstr("key=a,b,c is needed"));
  EXPECT_EQ(sweep({}), 2);
  EXPECT_EQ(command({"sweep", "-", "--vary", "a=1"}), 2);
  write_text(folder_ / "t.csv", "my own notes\n");
  EXPECT_EQ(sweep({"--vary", "analysis.end_time=0.1"}), 2);
  EXPECT_EQ(text("t.csv"), "my own notes\n");
  EXPECT_FALSE(std::filesystem::exists(runs()));
}

}  // namespace
}  // namespace ashlar::sweep_command_test
