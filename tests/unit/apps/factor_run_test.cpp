// `ashlar run` and `ashlar check` of searches for a factor of safety and for a load factor.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/results/folder/scene_identity.hpp"
#include "apps/run/answers/trial_folder.hpp"
#include "apps/run/answers/trial_run.hpp"
#include "unit/apps/run_fixture.hpp"

namespace ashlar::factor_run_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A plate of 2 m x 2 m x 0.5 m on a slope of 30 degrees, 4000 kg: its weight meets the slope in its middle third.
std::string plate_on_a_slope(const std::string& analysis, const std::string& contact) {
  return analysis + "\n[contact]\n" + contact + "\n" + rock_text + plate_text;
}

const char* const safety = "[analysis]\ntype = \"factor-of-safety\"\n";
const char* const elastic = "[analysis]\ntype = \"factor-of-safety\"\nmethod = \"elastic\"\n";

/// Limit analysis does not apply to joints that lose strength, so that only static analyses search for the factor.
const char* const brittle = "friction_angle = 40\nfriction_angle_residual = 39";

class FactorRun : public RunCommand {
 protected:
  nlohmann::json summary(const std::string& out) {
    return nlohmann::json::parse(text(out + "/summary.json"));
  }

  /// Middle of the bracket in the summary, which has to hold the reference.
  double factor(const nlohmann::json& found, double reference) {
    EXPECT_LT(found.at("lower").get<double>(), 1.002 * reference);
    EXPECT_GT(found.at("upper").get<double>(), 0.998 * reference);
    return std::sqrt(found.at("lower").get<double>() * found.at("upper").get<double>());
  }
};

TEST_F(FactorRun, SlidingByFriction) {
  write_text(scene_, plate_on_a_slope(safety, "friction_angle = 40"));
  ASSERT_EQ(command({"run", scene_.string(), "--out", (folder_ / "out").string()}), 0) << faults_;
  EXPECT_THAT(faults_, HasSubstr("factor of safety between"));
  const nlohmann::json all = summary("out");
  EXPECT_EQ(all.at("status"), "completed");
  const nlohmann::json& found = all.at("factor_of_safety");
  const double reference = std::tan(40.0 * M_PI / 180.0) / std::tan(30.0 * M_PI / 180.0);  // 1.453
  EXPECT_NEAR(factor(found, reference), reference, 0.01 * reference);
  EXPECT_THAT(found.at("moving"), ElementsAre("stone"));
  EXPECT_EQ(found.at("joints").at(0).at("mode"), "slides");
  // Down the slope, along (cos, 0, sin) of 210 degrees.
  const auto& acceleration = found.at("accelerations").at(0);
  EXPECT_LT(acceleration.at(0).get<double>(), 0.0);
  EXPECT_NEAR(acceleration.at(2).get<double>() / acceleration.at(0).get<double>(), std::tan(M_PI / 6.0),
              1e-2);
  EXPECT_EQ(all.at("scene").at("analysis").at("type"), "factor-of-safety");
}

TEST_F(FactorRun, SlidingByCohesionThatLasts) {
  // (W cos(30) tan(20) + c A) / (W sin(30)), W = 4000 g, A = 4: 0.6304 + 20000 / 19620 = 1.6498.
  write_text(scene_,
             plate_on_a_slope(safety, "friction_angle = 20\ncohesion = 5e3\ncohesion_residual = 5e3"));
  ASSERT_EQ(run("out"), 0) << faults_;
  const double reference = std::tan(M_PI / 9.0) * std::sqrt(3.0) + 2e4 / (2e3 * 9.81);
  EXPECT_NEAR(factor(summary("out").at("factor_of_safety"), reference), reference, 0.01 * reference);
}

TEST_F(FactorRun, OnlyNamedJointsLoseStrength) {
  // The weak joint below has 35 degrees for good; the block on top, of the same size, 45.
  write_text(scene_,
             plate_on_a_slope(std::string(safety) + "safety = { joints = [\"top\"], tolerance = 0.02 }",
                              "friction_angle = 35") +
                 R"(
[[joint]]
blocks = ["stone", "top"]
friction_angle = 45
[[block]]
name = "top"
material = "rock"
box = { min = [-1, -1, 0.5], max = [1, 1, 1] }
rotate = { axis = [0, -1, 0], angle = 30 }
)");
  ASSERT_EQ(run("out"), 0) << faults_;
  const nlohmann::json all = summary("out");
  const double reference = std::sqrt(3.0);
  EXPECT_NEAR(factor(all.at("factor_of_safety"), reference), reference, 0.02 * reference);
  EXPECT_THAT(all.at("factor_of_safety").at("moving"), ElementsAre("top"));
}

TEST_F(FactorRun, WhatMovesAtAllStrengthsAndWhatNothingMoves) {
  write_text(scene_, plate_on_a_slope(safety, "friction_angle = 2"));
  ASSERT_EQ(command({"run", scene_.string(), "--out", (folder_ / "moves").string()}), 0) << faults_;
  EXPECT_THAT(faults_, HasSubstr("no factor of safety down to 0.1"));
  EXPECT_TRUE(summary("moves").at("factor_of_safety").at("lower").is_null());
  write_text(scene_,
             plate_on_a_slope(safety, "friction_angle = 2") +
                 "[[block.fix]]\nplane = { point = [0, 0, 0], normal = [0.5, 0, -0.866025403784] }\n");
  EXPECT_EQ(command({"run", scene_.string(), "--out", (folder_ / "stands").string()}), 2);
  EXPECT_THAT(faults_, HasSubstr("no block can move"));
}

TEST_F(FactorRun, CapacityIsTheLoadThatMovesABlock) {
  // A cube of 1 m and 2000 kg on level ground, pushed along its base by 1000 N: slides at W tan(30) = 11328 N.
  write_text(scene_, std::string(R"([analysis]
type = "capacity"
capacity = { lower = 0.5, upper = 100, tolerance = 0.01 }
[contact]
friction_angle = 30
)") + rock_text + R"([[block]]
name = "ground"
fixed = true
box = { min = [-4, -4, -1], max = [4, 4, 0] }
[[block]]
name = "stone"
material = "rock"
box = { min = [0, 0, 0], max = [1, 1, 1] }
[[block.load]]
point = [0, 0.5, 0.1]
force = [1000, 0, 0]
)");
  ASSERT_EQ(command({"run", scene_.string(), "--out", (folder_ / "out").string()}), 0) << faults_;
  EXPECT_THAT(faults_, HasSubstr("load factor between"));
  const double reference = 2.0 * 9.81 / std::sqrt(3.0);
  EXPECT_NEAR(factor(summary("out").at("load_factor"), reference), reference, 0.01 * reference);
  EXPECT_THAT(summary("out").at("load_factor").at("moving"), ElementsAre("stone"));
}

TEST_F(FactorRun, ResumeKeepsTrialsAndEndsAlike) {
  write_text(scene_, plate_on_a_slope(elastic, brittle));
  ASSERT_EQ(run("whole"), 0) << faults_;
  ASSERT_EQ(run("half"), 0) << faults_;
  // As if it had been killed after three trials.
  nlohmann::ordered_json trials = nlohmann::ordered_json::parse(text("half/factor_trials.json"));
  auto& list = trials.at("trials");
  ASSERT_GT(list.size(), 4U);
  const nlohmann::ordered_json all = list;
  list.erase(list.begin() + 3, list.end());
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "half"))
    if (const auto name = entry.path().filename(); name != ".ashlar" && name != "scene.json")
      std::filesystem::remove_all(entry.path());
  write_text(folder_ / "half/factor_trials.json", trials.dump(1) + "\n");
  ASSERT_EQ(run("half", {"--resume"}), 0) << faults_;
  EXPECT_EQ(nlohmann::ordered_json::parse(text("half/factor_trials.json")).at("trials"), all);
  EXPECT_EQ(summary("half").at("factor_of_safety"), summary("whole").at("factor_of_safety"));
  expect_same_results("whole", "half");
  // Results of another scene.
  trials["scene"] = 1;
  std::filesystem::remove(folder_ / "half/summary.json");
  write_text(folder_ / "half/factor_trials.json", trials.dump(1) + "\n");
  EXPECT_NE(run("half", {"--resume"}), 0);
}

TEST_F(FactorRun, ATrialThatWasStoppedGoesOn) {
  write_text(scene_, plate_on_a_slope(elastic, brittle));
  ASSERT_EQ(run("whole"), 0) << faults_;
  ASSERT_EQ(run("half"), 0) << faults_;
  // As if it had been stopped in its first trial.
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "half"))
    if (entry.path().filename() != ".ashlar") std::filesystem::remove_all(entry.path());
  Diagnostics diagnostics;
  const std::optional<LoadedScene> loaded = load_scene(scene_, {}, diagnostics);
  ASSERT_TRUE(loaded);
  TrialRun stopped(*loaded, 1.0, 1);
  ASSERT_TRUE(stopped.iterate() && stopped.iterate());
  {
    const auto claim = std::make_shared<const FolderClaim>(folder_ / "half", ClaimPurpose::replacement);
    TrialFolder(claim, scene_identity(*loaded).scene, false, std::nullopt)
        .save(stopped.factor(), stopped.state());
  }
  ASSERT_EQ(run("half", {"--resume"}), 0) << faults_;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "half" / trial_state_name));
  EXPECT_EQ(summary("half").at("factor_of_safety"), summary("whole").at("factor_of_safety"));
  expect_same_results("whole", "half");
}

TEST_F(FactorRun, AnElasticSearchBeginsWithWhatLimitAnalysisFinds) {
  write_text(scene_, plate_on_a_slope(elastic, "friction_angle = 40"));
  ASSERT_EQ(run("out"), 0) << faults_;
  const nlohmann::json found = summary("out").at("factor_of_safety");
  EXPECT_EQ(found.at("method"), "elastic");
  ASSERT_EQ(found.at("trials").size(), 2U);
  EXPECT_EQ(found.at("lower"), found.at("limit").at("lower"));
  EXPECT_EQ(found.at("upper"), found.at("limit").at("upper"));
  const double reference = std::tan(40.0 * M_PI / 180.0) / std::tan(30.0 * M_PI / 180.0);
  EXPECT_NEAR(factor(found, reference), reference, 0.01 * reference);
}

TEST_F(FactorRun, BlocksThatOthersHoldAreNamed) {
  // A stone between two that press on it from its sides: alone it falls.
  write_text(scene_, std::string(R"([analysis]
type = "factor-of-safety"
[contact]
friction_angle = 40
)") + rock_text + R"([[block]]
name = "left"
fixed = true
box = { min = [-2, 0, 0], max = [-1, 1, 1] }
[[block]]
name = "ground"
fixed = true
box = { min = [1, 0, -1], max = [3, 1, 0] }
[[block]]
name = "middle"
material = "rock"
order = 0
box = { min = [-1, 0, 0], max = [1, 1, 1] }
[[block]]
name = "right"
material = "rock"
order = 0
box = { min = [1, 0, 0], max = [2, 1, 1] }
[[block.load]]
point = [2, 0.5, 0.5]
force = [-200000, 0, 0]
)");
  ASSERT_EQ(run("out"), 0) << faults_;
  const nlohmann::json found = summary("out").at("factor_of_safety");
  EXPECT_THAT(found.at("kept_by_others"), ElementsAre("middle"));
  EXPECT_THAT(summary("out").at("message").get<std::string>(),
              HasSubstr("block middle would move below it but for the pressure of other blocks"));
}

TEST_F(FactorRun, FaultsHaveTheirPlace) {
  const auto fault = [&](const std::string& analysis, const std::string& contact) {
    write_text(scene_, plate_on_a_slope(analysis, contact));
    EXPECT_EQ(command({"check", scene_.string()}), 2);
    return faults_;
  };
  const std::string type = safety;
  EXPECT_THAT(fault(type + "safety = { joints = [\"stane\"] }", "friction_angle = 40"),
              AllOf(HasSubstr("s.toml:3:"), HasSubstr("stane"), HasSubstr("stone")));
  EXPECT_THAT(fault(type + "safety = { lower = 2, upper = 1 }", "friction_angle = 40"),
              AllOf(HasSubstr("s.toml:3:"), HasSubstr("upper is not above lower")));
  EXPECT_THAT(fault(type + "safety = { joints = [] }", "friction_angle = 40"), HasSubstr("joints is empty"));
  EXPECT_THAT(fault("[analysis]\ntype = \"capacity\"", "friction_angle = 40"), HasSubstr("names no load"));
  EXPECT_THAT(fault(type, "friction_angle = 30\nfriction_angle_residual = 31"),
              AllOf(HasSubstr("s.toml:6:"), HasSubstr("friction_angle_residual is above friction_angle")));
  EXPECT_THAT(fault(type, "friction_angle = 30\ncohesion_residual = 1"), HasSubstr("cohesion_residual"));
}

}  // namespace
}  // namespace ashlar::factor_run_test
