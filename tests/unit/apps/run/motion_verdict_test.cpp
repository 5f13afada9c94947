// Verdict at the end of a run in time: who rests, moves or has fallen, and the peaks of measures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::motion_verdict_test {
namespace {

using ::testing::HasSubstr;

class MotionVerdictOfRun : public RunCommand {
 protected:
  nlohmann::json summary_of(const std::string& scene, const std::vector<std::string>& more = {"--force"}) {
    write_text(scene_, scene);
    EXPECT_EQ(run("out", more), exit_status::done) << faults_;
    return nlohmann::json::parse(text("out/summary.json"));
  }
};

/// A cube of 1 m, its lower face at a height over a floor that is inclined by gravity.
std::string cube(double height, double end_time, const std::string& gravity, const std::string& contact) {
  return "analysis = { type = \"dynamic\", time_step = 1e-3, end_time = " + std::to_string(end_time) +
         ", gravity = " + gravity + " }\ncontact = " + contact + R"(
material = [{ name = "stone", density = 2000, young_modulus = 1e9, poisson_ratio = 0.2 }]
measure = [{ name = "top", block = "cube", point = [0.5, 0.5, )" +
         std::to_string(height + 1.0) + R"(] }]
[[block]]
name = "floor"
fixed = true
box = { min = [-5, -5, -1], max = [9, 5, 0] }
[[block]]
name = "cube"
material = "stone"
order = 0
box = { min = [0, 0, )" +
         std::to_string(height) + "], max = [1, 1, " + std::to_string(height + 1.0) + "] }\n";
}

// It is lower by half its size after sqrt(2 x 0.5 / 9.81) s, and lies on the floor at the end, 0.8 m lower.
TEST_F(MotionVerdictOfRun, ABlockThatHasFallenIsToldWithItsTime) {
  const auto summary =
      summary_of(cube(0.8, 1.5, "[0, 0, -9.81]", "{ friction_angle = 30, restitution = 0 }"));
  const nlohmann::json& verdict = summary.at("verdict");
  EXPECT_EQ(verdict.at("state"), "at rest");
  ASSERT_EQ(verdict.at("fallen").size(), 1U);
  EXPECT_NEAR(verdict.at("fallen")[0].at("time"), std::sqrt(1.0 / 9.81), 2e-3);
  EXPECT_NEAR(verdict.at("fallen")[0].at("drop"), 0.8, 1e-3);
  EXPECT_THAT(summary.at("message").get<std::string>(),
              HasSubstr("at rest; 1 of 1 blocks has fallen: cube at 0.3"));
}

// A continued run remembers what fell before.
TEST_F(MotionVerdictOfRun, AContinuedRunRemembersFalls) {
  const std::string contact = "{ friction_angle = 30, restitution = 0 }";
  summary_of(cube(0.8, 0.6, "[0, 0, -9.81]", contact));
  const auto summary = summary_of(cube(0.8, 1.5, "[0, 0, -9.81]", contact), {"--resume"});
  ASSERT_EQ(summary.at("verdict").at("fallen").size(), 1U);
  EXPECT_NEAR(summary.at("verdict").at("fallen")[0].at("time"), std::sqrt(1.0 / 9.81), 2e-3);
}

// Down a slope of 40 degrees with friction of 30 for 1 s: v = g (sin 40 - cos 40 tan 30). It goes 0.98 m along the slope, of
// which 0.63 m is down.
TEST_F(MotionVerdictOfRun, ABlockThatSlidesMoves) {
  const double degree = 3.14159265358979 / 180.0;
  const double a = 9.81 * (std::sin(40 * degree) - std::cos(40 * degree) * std::tan(30 * degree));
  const auto summary = summary_of(
      cube(0.0, 1.0, "[\"= 9.81*sin(40*deg)\", 0, \"= -9.81*cos(40*deg)\"]", "{ friction_angle = 30 }"));
  const nlohmann::json& verdict = summary.at("verdict");
  EXPECT_EQ(verdict.at("state"), "moving");
  EXPECT_EQ(verdict.at("fastest"), "cube");
  EXPECT_NEAR(verdict.at("speed"), a, 0.02 * a);
  ASSERT_EQ(verdict.at("fallen").size(), 1U);
  EXPECT_NEAR(verdict.at("fallen")[0].at("drop"), 0.5 * a * std::sin(40 * degree), 0.03);
  EXPECT_NEAR(verdict.at("fallen")[0].at("runout"), 0.5 * a * std::cos(40 * degree), 0.03);
  EXPECT_EQ(verdict.at("fallen")[0].at("below_all_held"), false);
  EXPECT_NEAR(summary.at("peaks").at("top.vx").at("largest").at("value"), a, 0.02 * a);
  EXPECT_EQ(summary.at("peaks").at("top.vx").at("unit"), "m/s");
  EXPECT_NEAR(summary.at("peaks").at("top.vx").at("largest").at("time"), 1.0, 1e-9);
  EXPECT_NEAR(summary.at("peaks").at("top.x").at("least").at("value"), 0.5, 1e-6);
  EXPECT_NEAR(summary.at("peaks").at("top.x").at("least").at("time"), 0.0, 2e-3);
}

// Beside the floor it falls by 4.9 m in a second, below the floor and below a beam that is held at its end.
TEST_F(MotionVerdictOfRun, ABlockBelowAllThatIsHeldIsTold) {
  const auto below = [&](const char* low) {
    std::string scene = cube(0.0, 1.0, "[0, 0, -9.81]", "{ friction_angle = 30 }");
    const std::string floor = "box = { min = [-5, -5, -1], max = [9, 5, 0] }";
    scene.replace(scene.find(floor), floor.size(), "box = { min = [-5, -5, -1], max = [-2, 5, 0] }");
    scene += std::string("[[block]]\nname = \"beam\"\nmaterial = \"stone\"\nbox = { min = [-5, 0, ") + low +
             "], max = [-4, 1, -1.5] }\nfix = [{ plane = { point = [-5, 0, 0], normal = [1, 0, 0] } }]\n";
    const auto summary = summary_of(scene);
    const nlohmann::json& fallen = summary.at("verdict").at("fallen")[0];
    EXPECT_EQ(fallen.at("block"), "cube");
    EXPECT_EQ(
        summary.at("message").get<std::string>().find("below all blocks that are held") != std::string::npos,
        fallen.at("below_all_held").get<bool>());
    return fallen.at("below_all_held").get<bool>();
  };
  EXPECT_TRUE(below("-2"));
  EXPECT_FALSE(below("-9"));
}

TEST_F(MotionVerdictOfRun, WhatStandsIsAtRest) {
  const auto summary = summary_of(cube(0.0, 0.2, "[1, 0, -9.81]", "{ friction_angle = 30 }"));
  EXPECT_EQ(summary.at("verdict").at("state"), "at rest");
  EXPECT_EQ(summary.at("message"), "at rest");
  EXPECT_TRUE(summary.at("verdict").at("fallen").empty());
  EXPECT_FALSE(summary.contains("states"));
}

TEST_F(MotionVerdictOfRun, SweepsHavePeaks) {
  write_text(scene_, cube(0.0, 0.1, "[\"= push\", 0, -9.81]", "{ friction_angle = 10 }") +
                         "\n[parameters]\npush = 5\n");
  ASSERT_EQ(command({"sweep", scene_.string(), "--vary", "parameters.push=5,6", "--value",
                     "peaks.top.vx.largest.value", "-o", (folder_ / "t.csv").string()}),
            exit_status::done)
      << faults_;
  const std::vector<double> peaks = column("t.csv", "peaks.top.vx.largest.value");
  ASSERT_EQ(peaks.size(), 2U);
  EXPECT_NEAR(peaks[0], 0.1 * (5 - 9.81 * std::tan(10 * 3.14159265358979 / 180)), 0.02);
  EXPECT_GT(peaks[1], peaks[0] + 0.08);
}

}  // namespace
}  // namespace ashlar::motion_verdict_test
