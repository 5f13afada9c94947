// Runs with bolts and props: their results, stages and checkpoints.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::support_run_test {
namespace {

using ::testing::HasSubstr;

// A cube of 2000 kg under a fixed roof that it does not touch; a bar of EA = 1e7 N and 1 m bears it.
const std::string hung = R"(title = "hung"
[analysis]
gravity = [0, 0, -10]
type = "static"
[contact]
friction_angle = 30
[[material]]
name = "stone"
density = 2000
young_modulus = 1e9
poisson_ratio = 0.0
[[block]]
name = "roof"
fixed = true
box = { min = [-1, -1, 2], max = [2, 2, 3] }
[[block]]
name = "cube"
material = "stone"
order = 0
box = { min = [0, 0, 0], max = [1, 1, 1] }
[[bolt]]
name = "bar"
anchored = "ends"
from = [0.5, 0.5, 2]
to = [0.5, 0.5, 1]
area = 1e-4
young_modulus = 1e11
[[measure]]
name = "force"
bolt = "bar"
[output]
every = 5
)";

class SupportRun : public RunCommand {
 protected:
  void scene(const std::string& text) { write_text(scene_, text); }
  [[nodiscard]] nlohmann::json summary(const std::string& out) const {
    return nlohmann::json::parse(text(out + "/summary.json"));
  }
};

TEST_F(SupportRun, ForcesAreInSummaryHistoryAndFrames) {
  scene(hung);
  ASSERT_EQ(run("one"), 0);
  const nlohmann::json support = summary("one")["support"];
  EXPECT_EQ(support["largest_tension"]["name"], "bar");
  EXPECT_NEAR(support["largest_tension"]["force"], 2e4, 1.0);
  EXPECT_TRUE(support["largest_compression"].is_null());
  EXPECT_EQ(support["states"]["elastic"], 1);
  EXPECT_THAT(lines("one/history.csv").front(), HasSubstr("force.axial_force,force.shear_force,force.state"));
  EXPECT_THAT(text("one/bolts.pvd"), HasSubstr("frames/bolts_"));
}

TEST_F(SupportRun, AStageTakesTheBarAwayAndTheBlockFalls) {
  scene(hung +
        "[[stage]]\nname = \"held\"\n[[stage]]\nname = \"free\"\nremove_support = [\"ba*\"]\n"
        "analysis = { type = \"dynamic\", end_time = 0.1, time_step = 1e-3 }\n");
  ASSERT_EQ(run("two"), 0);
  EXPECT_EQ(summary("two")["support"]["states"]["absent"], 1);
  EXPECT_NEAR(summary("two")["largest_displacement"]["value"], 0.05, 0.004);
}

/// The scene with more keys of the bar.
std::string hung_on(const std::string& keys) {
  std::string text = hung;
  return text.insert(text.find("[[measure]]"), keys);
}

TEST_F(SupportRun, LimitAnalysisCountsTheirStrength) {
  // The cube weighs 20 kN, its load is 10 kN: with a yield force of 50 kN the factor is 3.
  scene(hung_on("yield_force = 5e4\n") +
        "[[assign]]\nblocks = [\"cube\"]\nload = [{ point = [0.5, 0.5, 0], force = [0, 0, -1e4] }]\n");
  ASSERT_EQ(run("limit", {"--set", "analysis.type=capacity"}), 0);
  const nlohmann::json found = summary("limit");
  EXPECT_EQ(found["load_factor"]["method"], "limit") << "auto";
  EXPECT_LE(found["load_factor"]["lower"], 3.0 * (1.0 + 1e-6));
  EXPECT_GE(found["load_factor"]["upper"], 3.0 * (1.0 - 1e-6));
  EXPECT_EQ(found["load_factor"]["bolts"][0]["name"], "bar");
  EXPECT_NEAR(found["load_factor"]["bolts"][0]["axial_force"], 5e4, 500.0);
  EXPECT_NEAR(found["support"]["largest_tension"]["force"], 5e4, 500.0);
  EXPECT_THAT(text("limit/bolts.pvd"), HasSubstr("frames/bolts_"));
  ASSERT_EQ(run("elastic", {"--set", "analysis.type=capacity", "--set", "analysis.method=elastic"}), 0);
  EXPECT_NEAR(summary("elastic")["load_factor"]["lower"], 3.0, 0.05);
}

// A cube of 24.5 kN that a bolt clamps to a wall: friction of 45 degrees carries it from a pretension of 24.5 kN on.
TEST_F(SupportRun, StaticAnalysesHoldWhatPretensionClamps) {
  const double weight = 2500.0 * 9.81;
  for (const int order : {0, 1}) {
    for (const double share : {1.1, 1.5, 2.0, 3.0}) {
      scene(fmt::format(R"(analysis = {{ type = "static" }}
contact = {{ friction_angle = 45 }}
material = [{{ name = "m", density = 2500, young_modulus = 1e10, poisson_ratio = 0.2 }}]
[[block]]
name = "wall"
fixed = true
box = {{ min = [0, -2, -2], max = [2, 2, 2] }}
[[block]]
name = "stone"
material = "m"
order = {}
box = {{ min = [-1, -0.5, -0.5], max = [0, 0.5, 0.5] }}
[[bolt]]
name = "b"
from = [-1, 0, 0]
to = [2, 0, 0]
area = 5e-4
anchored = "ends"
yield_force = 1e6
pretension = {}
)",
                        order, share * weight));
      ASSERT_EQ(run("clamped", {"--force"}), 0) << faults_;
      EXPECT_EQ(summary("clamped")["status"], "equilibrium") << order << ' ' << share;
    }
  }
}

TEST_F(SupportRun, LimitAnalysisTellsWhatItDoesNotCount) {
  const auto said = [&](const std::string& keys) {
    scene(hung_on(keys));
    EXPECT_EQ(
        run("told", {"--force", "--set", "analysis.type=factor-of-safety", "--set", "analysis.method=limit"}),
        0);
    return faults_;
  };
  EXPECT_THAT(said(""), HasSubstr("\"bar\" in limit analysis: its force has no limit"));
  EXPECT_THAT(said("yield_force = 5e4\npretension = 1e4\n"),
              HasSubstr("pretension (10000 N) counts along the path from rest"));
  EXPECT_THAT(said("yield_force = 5e4\nrupture_strain = 0.1\n"), HasSubstr("it breaks at 20 times"));
  EXPECT_THAT(said("yield_force = 5e4\nrupture_strain = 0.001\n"), HasSubstr("it breaks before it yields"));
}

TEST_F(SupportRun, MovementsOfSupportsRefuseThem) {
  scene(hung);
  EXPECT_EQ(run("moved", {"--set", "analysis.type=thrust", "--set", "analysis.movement.supports=[\"roof\"]"}),
            2);
}

}  // namespace
}  // namespace ashlar::support_run_test
