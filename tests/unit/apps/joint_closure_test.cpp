// Messages of a run on joints that are closed beyond their curve.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::joint_closure_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double weight = 2500.0 * 9.81;  // Pa, of a cube on its joint
constexpr double closure = 1e-4;          // m, the largest of the joint

/// The cube on a joint whose initial stiffness times its largest closure is this share of the pressure.
std::string cube_on_joint(double share) {
  return fmt::format(R"([analysis]
type = "static"
[contact]
normal_stiffness = {}
maximum_closure = {}
augmented = false
[[material]]
name = "rock"
density = 2500
young_modulus = 1e10
poisson_ratio = 0.2
[[block]]
name = "floor"
fixed = true
box = {{ min = [-1, -1, -1], max = [2, 2, 0] }}
[[block]]
name = "stone"
material = "rock"
order = 0
box = {{ min = [0, 0, 0], max = [1, 1, 1] }}
)",
                     share * weight / closure, closure);
}

TEST_F(RunCommand, AJointWithinItsCurveIsClosedAsItSays) {
  write_text(scene_, cube_on_joint(1.0 / 79.0));
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const auto most = nlohmann::json::parse(text("out/summary.json"))["most_closed"];
  EXPECT_NEAR(most["of_maximum"], 79.0 / 80.0, 1e-6);  // x/(1 - x) = 79
  EXPECT_EQ(most["blocks"], (nlohmann::json{"floor", "stone"}));
  EXPECT_THAT(faults_, Not(HasSubstr("maximum_closure")));
}

TEST_F(RunCommand, ARunWarnsOfAJointClosedBeyondItsCurve) {
  write_text(scene_, cube_on_joint(1.0 / 199.0));
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  const auto most = nlohmann::json::parse(text("out/summary.json"))["most_closed"];
  EXPECT_NEAR(most["of_maximum"], 1.0, 1e-6);  // 99 + 1e4 (x - 0.99) = 199
  EXPECT_THAT(faults_,
              HasSubstr("the joint of blocks floor and stone was closed by 1 of its maximum_closure"));
}

}  // namespace
}  // namespace ashlar::joint_closure_test
