// Messages of a run on friction lost by multipliers.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::sliding_friction_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A cube of 2500 kg slides on a floor, 3 m/s at first.
constexpr const char* slide = R"([analysis]
end_time = 0.05
time_step = 2.5e-5
[contact]
friction_angle = 30
[[material]]
name = "rock"
density = 2500
young_modulus = 1e9
poisson_ratio = 0.0
[[block]]
name = "floor"
fixed = true
box = { min = [-1, -1, -1], max = [4, 2, 0] }
[[block]]
name = "stone"
material = "rock"
box = { min = [0, 0, 0], max = [1, 1, 1] }
velocity = [3, 0, 0]
[output]
every = 100000
)";

/// N s, of friction by hand. @param rise momentum upwards that the stone has gained
double coulomb_impulse(double rise) {
  return std::tan(std::acos(-1.0) / 6.0) * (2500.0 * 9.81 * 0.05 + rise);
}

TEST_F(RunCommand, FrictionThatActedIsTheMomentumThatASlidingStoneLost) {
  write_text(scene_, slide);
  ASSERT_EQ(run("out", {"--set", "contact.augmented=true"}), exit_status::done) << faults_;
  const auto friction = nlohmann::json::parse(text("out/summary.json"))["sliding_friction"];
  const double lost = 3.0 * 2500.0 - column("out/history.csv", "momentum.x").back();
  EXPECT_NEAR(friction["acted"], lost, 1e-3 * lost);
  const double coulomb = coulomb_impulse(column("out/history.csv", "momentum.z").back());
  EXPECT_NEAR(friction["coulomb"], coulomb, 0.02 * coulomb)
      << "points that are locked for a step do not count";
  ASSERT_LT(lost, 0.97 * coulomb) << "the scene loses friction";
  EXPECT_THAT(faults_, HasSubstr("of the friction has acted that Coulomb's law makes"));
}

TEST_F(RunCommand, SpringsLoseNoFriction) {
  write_text(scene_, slide);
  ASSERT_EQ(run("out"), exit_status::done) << faults_;
  EXPECT_THAT(faults_, Not(HasSubstr("Coulomb")));
  EXPECT_FALSE(nlohmann::json::parse(text("out/summary.json")).contains("sliding_friction"));
  const double lost = 3.0 * 2500.0 - column("out/history.csv", "momentum.x").back();
  const double coulomb = coulomb_impulse(column("out/history.csv", "momentum.z").back());
  EXPECT_NEAR(lost, coulomb, 5e-3 * coulomb);
}

}  // namespace
}  // namespace ashlar::sliding_friction_test
