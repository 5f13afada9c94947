// Messages of `ashlar run` on deep penetration, and resumption of such runs.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::depth_run_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// The cube of the fixture, 450 kg with side 0.5 m, comes down with 0.5 m/s on springs of 1.25e7 N/m:
// 0.5 * sqrt(450 / 1.25e7) = 3.0e-3 m deep at most, as the beam yields, and twice that with 1 m/s.

TEST_F(RunCommand, DepthBeyondWhatTheSceneAllowsFails) {
  ASSERT_EQ(run("allowed", {"--set", "contact.allowed_depth=0.004"}), exit_status::done) << faults_;
  const auto allowed = nlohmann::json::parse(text("allowed/summary.json"));
  EXPECT_GT(allowed["deepest"]["value"], 2.8e-3);
  EXPECT_LT(allowed["deepest"]["value"], 4e-3);

  // The depth of contacts is allowed beyond it: springs of a given stiffness have the given compliance.
  ASSERT_EQ(run("given", {"--set", "contact.allowed_depth=0.001"}), exit_status::done) << faults_;

  ASSERT_EQ(run("failed", {"--set", "contact.allowed_depth=0.001", "--set", "contact.normal_stiffness=auto",
                           "--set", "block.A.velocity=[0, 0, -200]"}),
            exit_status::failed);
  EXPECT_THAT(faults_, AllOf(HasSubstr("block A"), HasSubstr("block B"), HasSubstr("0.001")));
  const auto failed = nlohmann::json::parse(text("failed/summary.json"));
  EXPECT_EQ(failed["status"], "failed");
  EXPECT_LE(failed["penetration_max"], 1e-3) << "of the last accepted state";
}

TEST_F(RunCommand, DepthThatIsNotOrdinaryIsAWarning) {
  ASSERT_EQ(run("ordinary"), exit_status::done) << faults_;
  EXPECT_THAT(faults_, Not(HasSubstr("deep in block")));
  ASSERT_EQ(run("fast", {"--set", "block.A.velocity=[0, 0, -1]"}), exit_status::done) << faults_;
  EXPECT_THAT(faults_, HasSubstr("warning: block A was 0.00"));
  EXPECT_THAT(faults_, HasSubstr("m deep in block B at t = 0.0"));
}

// A corner dropped into a V-shaped groove of one mesh slides in it with the memory of the audit.
constexpr const char* groove_scene = R"([analysis]
end_time = 0.12
time_step = 1e-3
[contact]
friction_angle = 10
restitution = "springs"
[[material]]
name = "stone"
density = 2500
young_modulus = 1e9
poisson_ratio = 0.2
[[block]]
name = "ground"
fixed = true
mesh = { file = "ground.obj" }
[[block]]
name = "point"
material = "stone"
hull = { points = [[0.155, 0.02, 0.62], [-0.145, 0.19, 0.61], [-0.145, -0.15, 0.62], [0.005, 0, 0.22]] }
[output]
every = 10
)";
constexpr const char* groove_mesh = R"(v -1 -2 0
v 1 -2 0
v 1 -2 1
v 0.8 -2 1
v 0 -2 0.2
v -0.8 -2 1
v -1 -2 1
v -1 2 0
v 1 2 0
v 1 2 1
v 0.8 2 1
v 0 2 0.2
v -0.8 2 1
v -1 2 1
f 1 2 3 4 5 6 7
f 14 13 12 11 10 9 8
f 8 9 2 1
f 9 10 3 2
f 10 11 4 3
f 11 12 5 4
f 12 13 6 5
f 13 14 7 6
f 14 8 1 7
)";

TEST_F(RunCommand, RunResumedPastItsEndInAGrooveIsTheRunThatNeverStopped) {
  write_text(scene_, groove_scene);
  write_text(folder_ / "ground.obj", groove_mesh);
  ASSERT_EQ(run("straight"), exit_status::done) << faults_;
  const auto summary = nlohmann::json::parse(text("straight/summary.json"));
  ASSERT_GT(summary["contact_depth_max"], 0.0) << "in contact";
  ASSERT_EQ(run("cut", {"--set", "analysis.end_time=0.06"}), exit_status::done) << faults_;
  for (const char* end : {"0.071", "0.085"})
    ASSERT_EQ(run("cut", {"--resume", "--set", std::string("analysis.end_time=") + end}), exit_status::done)
        << faults_;
  ASSERT_EQ(run("cut", {"--resume"}), exit_status::done) << faults_;
  expect_same_results("straight", "cut");
}

}  // namespace
}  // namespace ashlar::depth_run_test
