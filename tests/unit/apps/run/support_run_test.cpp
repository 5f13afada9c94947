// Runs with bolts and props: their results, stages and checkpoints.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "unit/apps/run_fixture.hpp"

namespace ashlar {
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

TEST_F(SupportRun, LimitAnalysisAndThrustRefuseThem) {
  scene(hung);
  EXPECT_EQ(run("limit", {"--set", "analysis.type=factor-of-safety", "--set", "analysis.method=limit"}), 2);
  EXPECT_EQ(run("thrust", {"--set", "analysis.type=thrust"}), 2);
}

}  // namespace
}  // namespace ashlar
