// Runs in stages: construction and excavation, one analysis after the other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::stages_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A stack of cubes of 1 m and 2000 kg on a fixed floor, order 1: the floor supports the weight of the stack.
const std::string stack = R"(title = "stack"
[analysis]
gravity = [0, 0, -10]
[contact]
friction_angle = 30
[[material]]
name = "stone"
density = 2000
young_modulus = 1e9
poisson_ratio = 0.0
[[block]]
name = "floor"
fixed = true
box = { min = [-1, -1, -1], max = [2, 2, 0] }
[[block]]
name = "low"
material = "stone"
box = { min = [0, 0, 0], max = [1, 1, 1] }
[[block]]
name = "high"
material = "stone"
box = { min = [0, 0, 1], max = [1, 1, 2] }
[[measure]]
name = "top"
block = "low"
point = [0.5, 0.5, 1]
[output]
every = 1000
)";

class Stages : public RunCommand {
 protected:
  void scene(const std::string& text) { write_text(scene_, text); }

  [[nodiscard]] nlohmann::json summary(const std::string& out) const {
    return nlohmann::json::parse(text(out + "/summary.json"));
  }

  /// Vertical normal force of a pair in the last rows of contacts.csv of a step.
  [[nodiscard]] double force(const std::string& out, const std::string& a, const std::string& b,
                             const std::string& step) const {
    for (const std::string& line : lines(out + "/contacts.csv")) {
      std::vector<std::string> fields;
      std::istringstream input(line);
      for (std::string field; std::getline(input, field, ',');) fields.push_back(field);
      if (fields[0] == step && fields[2] == a && fields[3] == b) return std::stod(fields[10]);
    }
    return std::nan("");
  }
};

TEST_F(Stages, WhatIsRemovedNoLongerWeighs) {
  scene(stack + R"(
[[stage]]
name = "both"
analysis = { type = "static" }
[[stage]]
name = "one"
remove = ["high"]
analysis = { type = "static" }
)");
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const nlohmann::json result = summary("out");
  ASSERT_EQ(result["status"], "equilibrium");
  ASSERT_EQ(result["stages"].size(), 2U);
  EXPECT_EQ(result["stages"][0]["name"], "both");
  EXPECT_EQ(result["stages"][0]["status"], "equilibrium");
  const std::string first = std::to_string(result["stages"][0]["steps"].get<int>());
  const std::string second = std::to_string(result["stages"][1]["steps"].get<int>());
  EXPECT_NEAR(std::abs(force("out", "floor", "low", first)), 40000.0, 1e-3);
  EXPECT_NEAR(std::abs(force("out", "low", "high", first)), 20000.0, 1e-3);
  EXPECT_NEAR(std::abs(force("out", "floor", "low", second)), 20000.0, 1e-3);
  EXPECT_TRUE(std::isnan(force("out", "low", "high", second)));
  // The load on the lower cube was its own weight and 20 kPa: its top went down by 20e3/1e9 m, and comes back by
  // that. Under its own weight alone an affine cube without lateral strain has its mean stress, 10 kPa.
  const std::vector<double> down = column("out/history.csv", "top.uz");
  const std::vector<double> stage = column("out/history.csv", "stage");
  ASSERT_EQ(down.size(), stage.size());
  EXPECT_EQ(stage.front(), 1.0);
  EXPECT_EQ(stage.back(), 2.0);
  const auto change = static_cast<std::size_t>(std::find(stage.begin(), stage.end(), 2.0) - stage.begin());
  EXPECT_NEAR(down.back() - down[change - 1], 20e3 / 1e9, 1e-3 * 20e3 / 1e9);
}

TEST_F(Stages, WhatIsAddedIsHeldBackUntilThen) {
  scene(stack + R"(
[[stage]]
name = "one"
analysis = { type = "static" }
[[stage]]
name = "both"
add = ["high"]
analysis = { type = "static" }
reset_displacement = true
)");
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const nlohmann::json result = summary("out");
  const std::string first = std::to_string(result["stages"][0]["steps"].get<int>());
  const std::string second = std::to_string(result["stages"][1]["steps"].get<int>());
  EXPECT_NEAR(std::abs(force("out", "floor", "low", first)), 20000.0, 1e-3);
  EXPECT_NEAR(std::abs(force("out", "floor", "low", second)), 40000.0, 1e-3);
  // Displacements count from the start of the second stage: 20 kPa more on 1 GPa.
  EXPECT_NEAR(column("out/history.csv", "top.uz").back(), -20e3 / 1e9, 1e-3 * 20e3 / 1e9);
}

// A block that falls for a second is where the next stage adds one: flush, so that no corner of one is within the other.
TEST_F(Stages, WhatIsAddedNeedsRoom) {
  const auto falling = [](double shift) {
    const std::string x = std::to_string(shift), end = std::to_string(shift + 1.0);
    return R"(
analysis = { end_time = 1, time_step = 1e-2, gravity = [0, 0, 0] }
contact = { friction_angle = 30 }
material = [{ name = "m", density = 2700, young_modulus = 1e10, poisson_ratio = 0.2 }]
[[block]]
name = "s"
material = "m"
box = { min = [0, 0, 2], max = [1, 1, 3] }
velocity = [0, 0, -1.5]
[[block]]
name = "t"
material = "m"
box = { min = [)" +
           x + ", 0, 0], max = [" + end + R"(, 1, 1] }
[[stage]]
name = "a"
[[stage]]
name = "b"
add = ["t"]
)";
  };
  scene(falling(0.0));
  EXPECT_EQ(run("out"), exit_status::failed);
  EXPECT_THAT(faults_,
              HasSubstr("stage b cannot begin: the stage adds block t where block s is now: they overlap by "
                        "0.5 m, allowed is 0.01 m"));
  const nlohmann::json result = summary("out");
  EXPECT_EQ(result["status"], "failed");
  EXPECT_EQ(result["time"], 1.0) << "the end of the first stage is kept";
  EXPECT_EQ(run("out", {"--resume"}), exit_status::failed) << "and goes on to the same end";
  EXPECT_THAT(faults_, HasSubstr("stage b cannot begin"));
  scene(falling(1.0));
  EXPECT_EQ(run("beside"), exit_status::done) << faults_;
  // Incremental blocks are where they have been carried to.
  const std::vector<std::string> incremental = {"--set", "analysis.formulation=incremental"};
  EXPECT_EQ(run("carried_beside", incremental), exit_status::done) << faults_;
  scene(falling(0.0));
  EXPECT_EQ(run("carried", incremental), exit_status::failed);
  EXPECT_THAT(faults_, HasSubstr("they overlap by 0.5 m"));
  // As deep as the scene allows.
  EXPECT_NE(run("allowed", {"--set", "contact.allowed_depth=0.6"}), exit_status::bad_input);
  EXPECT_THAT(faults_, ::testing::Not(HasSubstr("cannot begin")));
}

TEST_F(Stages, LoadsAndSupportsComeWithTheirStage) {
  scene(stack + R"(
[[stage]]
name = "rest"
analysis = { type = "static" }
[[stage]]
name = "pressed"
analysis = { type = "static", end_time = 1, time_step = 0.5 }
[[stage.load]]
blocks = ["high"]
plane = { point = [0, 0, 2], normal = [0, 0, 1] }
force = [0, 0, -5000]
history = [[0, 0], [1, 2]]
[[stage]]
name = "stays"
analysis = { type = "static" }
[[stage]]
name = "held"
gravity = [0, 0, 0]
)");
  // A key that no stage has.
  EXPECT_EQ(run("out"), exit_status::bad_input);
  EXPECT_THAT(faults_, HasSubstr("gravity"));
  std::string text = read_text(scene_);
  text.erase(text.find("[[stage]]\nname = \"held\""));
  scene(text);
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const nlohmann::json result = summary("out");
  ASSERT_EQ(result["stages"].size(), 3U);
  const auto weight = [&](int stage) {
    return std::abs(
        force("out", "floor", "low",
              std::to_string(result["stages"][static_cast<std::size_t>(stage)]["steps"].get<int>())));
  };
  EXPECT_NEAR(weight(0), 40000.0, 1e-3);
  EXPECT_NEAR(weight(1), 50000.0, 1e-3);
  // Its history has ended, with its last value.
  EXPECT_NEAR(weight(2), 50000.0, 1e-3);
}

// A cube on an incline of 30 degrees that friction of 40 degrees holds; then the joint is given 10 degrees:
// it slides with g (sin 30 - cos 30 tan 10).
TEST_F(Stages, AStaticStageIsTheStartOfMotion) {
  scene(R"(
[analysis]
gravity = [5, 0, -8.660254037844386]
[contact]
friction_angle = 40
[[material]]
name = "stone"
density = 2000
young_modulus = 1e9
poisson_ratio = 0.2
[[block]]
name = "floor"
fixed = true
box = { min = [-1, -1, -1], max = [9, 2, 0] }
[[block]]
name = "cube"
material = "stone"
box = { min = [0, 0, 0], max = [1, 1, 1] }
[[measure]]
name = "corner"
block = "cube"
point = [0.5, 0.5, 0]
[[stage]]
name = "held"
analysis = { type = "static" }
[[stage]]
name = "let go"
analysis = { type = "dynamic", end_time = 0.5, time_step = 1e-3 }
reset_displacement = true
[[stage.joint]]
blocks = ["*", "cube"]
friction_angle = 10
)");
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  EXPECT_EQ(summary("out")["status"], "completed");
  const std::vector<double> time = column("out/history.csv", "time");
  EXPECT_DOUBLE_EQ(time.back(), 0.5);
  const double acceleration = 5.0 - 8.660254037844386 * std::tan(10.0 * std::acos(-1.0) / 180.0);
  const double displacement = 0.5 * acceleration * 0.25;
  EXPECT_NEAR(column("out/history.csv", "corner.ux").back(), displacement, 0.005 * displacement);
  EXPECT_NEAR(column("out/history.csv", "corner.vx").back(), 0.5 * acceleration, 0.002 * acceleration);
}

TEST_F(Stages, AStaticStageThatMovesEndsTheRun) {
  scene(stack + R"(
[[stage]]
name = "both"
analysis = { type = "static" }
[[stage]]
name = "undermined"
remove = ["floor"]
analysis = { type = "static" }
[[stage]]
name = "never"
analysis = { type = "static" }
)");
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const nlohmann::json result = summary("out");
  EXPECT_EQ(result["status"], "moving");
  ASSERT_EQ(result["stages"].size(), 2U);
  EXPECT_EQ(result["stages"][1]["name"], "undermined");
  ASSERT_EQ(result["moving"].size(), 2U);
  for (const auto& moving : result["moving"])
    EXPECT_NEAR(moving["acceleration"][2].get<double>(), -10.0, 1e-6) << moving["block"];
}

TEST_F(Stages, GoOnFromACheckpointOfALaterStageToTheBit) {
  const std::string stages = R"(
[[stage]]
name = "settle"
analysis = { type = "static" }
reset_displacement = true
[[stage]]
name = "fall"
remove = ["low"]
analysis = { type = "dynamic", end_time = 0.05, time_step = 1e-3 }
[[stage]]
name = "rise"
analysis = { type = "dynamic", end_time = 0.02, time_step = 1e-3, gravity = [0, 0, 10] }
)";
  scene(stack + stages);
  ASSERT_EQ(run("whole", {"--set", "output.every=7"}), exit_status::done) << faults_;
  ASSERT_EQ(run("part", {"--set", "output.every=7", "--set", "stage.rise.analysis.end_time=0.011"}),
            exit_status::done)
      << faults_;
  ASSERT_EQ(run("part", {"--set", "output.every=7", "--resume"}), exit_status::done) << faults_;
  expect_same_results("whole", "part");
  EXPECT_EQ(summary("whole")["stages"], summary("part")["stages"]);
}

TEST_F(Stages, FaultsAreToldAtTheirKeys) {
  const auto faults_of = [&](const std::string& stages) {
    scene(stack + stages);
    EXPECT_EQ(run("out"), exit_status::bad_input);
    return faults_;
  };
  EXPECT_THAT(faults_of("[[stage]]\nname = \"a\"\nremove = [\"hihg\"]\nanalysis = { type = \"static\" }\n"),
              HasSubstr("stage names no block (\"hihg\"), did you mean \"high\"?"));
  EXPECT_THAT(faults_of("[[stage]]\nname = \"a\"\nremove = [\"high\"]\nanalysis = { type = \"static\" }\n"
                        "[[stage]]\nname = \"b\"\nremove = [\"high\"]\nanalysis = { type = \"static\" }\n"),
              HasSubstr("block \"high\" is absent before this stage (remove)"));
  EXPECT_THAT(faults_of("[[stage]]\nname = \"a\"\n"), HasSubstr("end_time"));
  EXPECT_THAT(faults_of("[[stage]]\nname = \"a\"\nanalysis = { type = \"capacity\" }\n"),
              HasSubstr("limit analysis in a stage (\"capacity\")"));
  EXPECT_THAT(faults_of("[[stage]]\nname = \"a\"\nanalysis = { type = \"static\" }\n[[stage]]\nname = \"a\"\n"
                        "analysis = { type = \"static\" }\n"),
              HasSubstr("stage named twice (\"a\")"));
  EXPECT_THAT(
      faults_of("[[stage]]\nname = \"a\"\nanalysis = { type = \"static\", time_step = 5, end_time = 1 }\n"),
      HasSubstr(":31:43: error: time_step is longer than the analysis (5)"));
}

// The lower cube shortens by rho g h^2 / 2E = 1e-5 m before the upper one is added, tied to its top.
TEST_F(Stages, ATieBeginsWithoutAGap) {
  const std::string added = R"(
[[joint]]
blocks = ["low", "high"]
tied = true
[[stage]]
name = "settle"
analysis = { type = "static" }
[[stage]]
name = "build"
add = ["high"]
analysis = { type = "static" }
)";
  scene(stack + added);
  EXPECT_EQ(run("settled"), exit_status::failed);
  EXPECT_THAT(faults_, HasSubstr("block high is added with a tie to block low, which has moved"));
  EXPECT_EQ(run("weightless", {"--set", "stage.settle.analysis.gravity=[0, 0, 0]"}), exit_status::done)
      << faults_;
}

}  // namespace
}  // namespace ashlar::stages_test
