#include "apps/scene/check/warnings/idle_keys.hpp"

#include <gmock/gmock.h>

#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::idle_keys_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> warnings(const std::string& text, const std::vector<std::string>& overrides = {}) {
  Diagnostics diagnostics;
  warn_of_idle_keys(parse_scene(text, "s.toml", overrides, diagnostics), diagnostics);
  return printed(diagnostics);
}

TEST(IdleKeys, SpectralRadiusIsThatOfGeneralizedAlpha) {
  EXPECT_THAT(warnings(sample()), IsEmpty());
  const std::string given = sample_with(3, "time_step = 0.01\nspectral_radius = 0.5");
  EXPECT_THAT(warnings(given),
              ElementsAre("s.toml:4:1: warning: spectral_radius has no effect: only integrator "
                          "= \"generalized-alpha\" has one"));
  EXPECT_THAT(warnings(given, {"analysis.integrator=generalized-alpha"}), IsEmpty());
}

TEST(IdleKeys, GravityGivesWayToItsHistory) {
  const std::string given = sample_with(3, "time_step = 0.01\ngravity = [0, 0, -9.81]");
  EXPECT_THAT(warnings(given), IsEmpty());
  EXPECT_THAT(warnings(given, {"analysis.gravity_history=[[0, 0, 0, -9.81]]"}),
              ElementsAre("s.toml:4:1: warning: gravity has no effect: gravity_history is in its place"));
}

TEST(IdleKeys, StaticAnalysisHasNoMotion) {
  const std::string given = sample_with(3,
                                        "time_step = 0.01\nmass_damping = 0.5\nstiffness_damping = 1e-3\n"
                                        "integrator = \"dda\"");
  EXPECT_THAT(warnings(given, {"block.B.velocity=[0, 0, 0]", "block.A.velocity=[0, 1, 0]"}), IsEmpty());
  EXPECT_THAT(
      warnings(given, {"block.B.velocity=[0, 0, 0]", "block.A.velocity=[0, 1, 0]",
                       "block.B.angular_velocity=[0, 1, 0]", "analysis.type=static"}),
      ElementsAre("s.toml:4:1: warning: mass_damping has no effect: a static analysis has no motion in "
                  "time",
                  "s.toml:5:1: warning: stiffness_damping has no effect: a static analysis has no motion in "
                  "time",
                  "s.toml:6:1: warning: integrator has no effect: a static analysis has no motion in "
                  "time",
                  "--set block.A.velocity=[0, 1, 0]: warning: velocity has no effect: a static "
                  "analysis has no motion in time",
                  "--set block.B.angular_velocity=[0, 1, 0]: warning: angular_velocity has no effect: a "
                  "static analysis has no motion in time"));
}

TEST(IdleKeys, PenetrationToleranceIsThatOfAugmentedContact) {
  const std::string given = sample_with(5, "penetration_tolerance = 1e-6");
  EXPECT_THAT(warnings(given),
              ElementsAre("s.toml:5:1: warning: penetration_tolerance has no effect: it is that "
                          "of augmented = true"));
  EXPECT_THAT(warnings(given, {"contact.augmented=true"}), IsEmpty());
}

TEST(IdleKeys, OnlySpringsInMotionAreDamped) {
  const std::string given = sample_with(5, "friction_angle = 30\ndamping = 0.1");
  EXPECT_THAT(warnings(given), IsEmpty());
  EXPECT_THAT(
      warnings(given, {"analysis.type=static"}),
      ElementsAre("s.toml:6:1: warning: damping has no effect: a static analysis has no motion in time"));
  EXPECT_THAT(
      warnings(given, {"contact.augmented=true"}),
      ElementsAre(
          "s.toml:6:1: warning: damping has no effect: multipliers hold joints here, and only springs "
          "are damped: augmented = false has springs"));
  // Motion that starts from statics has multipliers unless a stiffness is given.
  EXPECT_THAT(
      warnings(given, {"analysis.initial_state=static"}),
      ElementsAre("s.toml:6:1: warning: damping has no effect: multipliers hold this joint, and only springs "
                  "are damped: normal_stiffness gives it some"));
  EXPECT_THAT(warnings(given, {"analysis.initial_state=static", "contact.normal_stiffness=1e9"}), IsEmpty());
  // Laws without multipliers have springs too, also where multipliers are asked for.
  EXPECT_THAT(warnings(given, {"analysis.initial_state=static", "contact.compressive_strength=1e7"}),
              IsEmpty());
  EXPECT_THAT(warnings(given, {"contact.augmented=true", "contact.compressive_strength=1e7"}), IsEmpty());
  const std::string of_joint = sample_with(7, "blocks = [\"A\", \"B\"]\ndamping = 0.1");
  EXPECT_THAT(
      warnings(of_joint, {"contact.augmented=true"}),
      ElementsAre(
          "s.toml:8:1: warning: damping has no effect: multipliers hold joints here, and only springs "
          "are damped: augmented = false has springs"));
}

TEST(IdleKeys, FixedBlocksHaveNoOrder) {
  EXPECT_THAT(warnings(sample_with(15, "order = 2\nfixed = true")),
              ElementsAre("s.toml:15:1: warning: order has no effect: a fixed block does not deform"));
}

TEST(IdleKeys, AnOrderOfManyBlocksIsThatOfTheFreeOnes) {
  const std::string stones = sample_with(
      16,
      "order = 0\nbox = { min = [0, 0, 1], max = [1, 1, 2] }\narray = { count = [2], step = [[0, 0, 1]] }");
  const std::string fixed = "[[assign]]\nblocks = [\"A.1\"]\nfixed = true\n";
  EXPECT_THAT(warnings(stones + fixed), IsEmpty());
  const std::string both = "[[assign]]\nblocks = [\"A.*\"]\nfixed = true\n";
  EXPECT_THAT(warnings(stones + both),
              ElementsAre("s.toml:16:1: warning: order has no effect: a fixed block does not deform"));
  // Of two keys the one for fixed blocks only.
  const std::string ordered = "[[assign]]\nblocks = [\"A.1\"]\nfixed = true\norder = 2\n";
  EXPECT_THAT(warnings(stones + ordered),
              ElementsAre("s.toml:37:1: warning: order has no effect: a fixed block does not deform"));
}

TEST(IdleKeys, TiedBlocksDoNotSlide) {
  const std::string given =
      sample_with(7, "blocks = [\"A\", \"B\"]\ntied = true\nfriction_angle = 20\ntensile_strength = 1e5");
  EXPECT_THAT(
      warnings(given),
      ElementsAre("s.toml:9:1: warning: friction_angle has no effect: tied blocks neither open nor slide",
                  "s.toml:10:1: warning: tensile_strength has no effect: tied blocks neither open nor "
                  "slide"));
  EXPECT_THAT(warnings(given, {"joint.0.tied=false"}), IsEmpty());
  EXPECT_THAT(warnings(given, {"joint.0.blocks=[\"A\", \"B*\"]"}), IsEmpty());
}

}  // namespace
}  // namespace ashlar::test::idle_keys_test
