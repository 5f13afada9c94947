// Warnings of `ashlar run` on spin that a step does not resolve.
#include <gmock/gmock.h>

#include <string>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::spin_run_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A free cube of rock, 1 m, that spins about an axis through its centre.
std::string spinning(double rate, const std::string& integrator) {
  return R"([analysis]
end_time = 0.5
time_step = 5e-3
gravity = [0, 0, 0]
integrator = ")" +
         integrator + R"("
[contact]
friction_angle = 30
[[material]]
name = "m"
density = 2500
young_modulus = 1e10
poisson_ratio = 0.2
[[block]]
name = "spinning"
material = "m"
box = { min = [0, 0, 0], max = [1, 1, 1] }
angular_velocity = [0, 0, )" +
         std::to_string(rate) + "]\n";
}

TEST_F(RunCommand, SpinOfMoreThanAStepResolvesIsAWarning) {
  // 60 rad/s in steps of 5 ms: points go along their tangents by 0.3 of their radius, and back to it, a turn by atan(0.3).
  // To first order that is sin(atan(0.3)) = 0.287.
  write_text(scene_, spinning(60.0, "dda"));
  ASSERT_EQ(run("fast"), exit_status::done) << faults_;
  EXPECT_THAT(faults_, AllOf(HasSubstr("warning: block spinning turned by 0.29"),
                             HasSubstr(" rad in the step to t = ")));
  write_text(scene_, spinning(6.0, "dda"));
  ASSERT_EQ(run("slow"), exit_status::done) << faults_;
  EXPECT_THAT(faults_, AllOf(Not(HasSubstr("turned by")), Not(HasSubstr("has added"))));
}

TEST_F(RunCommand, StepsThatAreShortenedForSpinAreAWarning) {
  write_text(scene_, spinning(60.0, "average-acceleration"));
  ASSERT_EQ(run("shortened"), exit_status::done) << faults_;
  EXPECT_THAT(faults_, AllOf(HasSubstr("steps were shortened so that no block turns by more than 0.03 rad"),
                             Not(HasSubstr("has added"))));
  const std::vector<double> kinetic = column("shortened/history.csv", "energy.kinetic");
  EXPECT_NEAR(kinetic.back() / kinetic.front(), 1.0, 0.01);
}

}  // namespace
}  // namespace ashlar::spin_run_test
