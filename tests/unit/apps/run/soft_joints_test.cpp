// Factors of rigid blocks on joints that yield where blocks tip (soft_joints.hpp).
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::soft_joints_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A cube of 1 m and 2000 kg on a joint, pushed at its top by half of its weight. @param stiffness Pa/m; "auto"
std::string pushed_cube(const std::string& stiffness) {
  return fmt::format(R"([analysis]
type = "capacity"
[contact]
friction_angle = 60
normal_stiffness = {0}
shear_stiffness = {0}
{1}
[[block]]
name = "floor"
fixed = true
box = {{ min = [-6, -2, -1], max = [3, 2, 0] }}
[[block]]
name = "stone"
material = "rock"
box = {{ min = [-0.5, -0.5, 0], max = [0.5, 0.5, 1] }}
load = [{{ point = [-0.5, 0, 1], force = [9810, 0, 0] }}]
)",
                     stiffness, rock_text);
}

TEST_F(RunCommand, AFactorTellsThatItsJointsAreSoft) {
  write_text(scene_, pushed_cube("1e8"));
  ASSERT_EQ(run("soft"), exit_status::done) << faults_;
  const std::string soft = nlohmann::json::parse(text("soft/summary.json"))["message"];
  // c = 19620 / 1e8 m, and (6 c)^(1/3) = 0.1056 of the load.
  EXPECT_THAT(soft, HasSubstr("joints are soft: that of floor and stone closes by 0.196 mm"));
  EXPECT_THAT(soft, HasSubstr("from about 11 % less on"));
  for (const char* stiff : {"1e11", "\"auto\""}) {
    write_text(scene_, pushed_cube(stiff));
    ASSERT_EQ(run("stiff", {"--force"}), exit_status::done) << faults_;
    EXPECT_THAT(text("stiff/summary.json"), Not(HasSubstr("joints are soft"))) << stiff;
  }
}

}  // namespace
}  // namespace ashlar::soft_joints_test
