#include "apps/scene/check/warnings/implausible_keys.hpp"

#include <gmock/gmock.h>

#include "apps/scene/assemble/scene_loading.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::implausible_keys_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> warnings(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  write_text(folder / "s.toml", text);
  // A tetrahedron 800 wide.
  write_text(folder / "scan.off",
             "OFF\n4 4 0\n0 0 10\n800 0 10\n0 800 10\n0 0 810\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  Diagnostics diagnostics;
  (void)load_scene(folder / "s.toml", overrides, diagnostics);
  std::vector<std::string> result;
  for (const std::string& line : printed(diagnostics)) result.push_back(line);
  return result;
}

TEST(ImplausibleKeys, AnglesBelowOneDegree) {
  EXPECT_THAT(warnings(sample(), {"contact.friction_angle=0.6"}),
              ElementsAre(HasSubstr(
                  "warning: friction_angle is in degrees (0.6): tan(0.6 deg) = 0.01; a coefficient of 0.6 "
                  "is 31 degrees, 0.6 rad are 34.4 degrees")));
  EXPECT_THAT(warnings(sample(), {"joint.0.friction_angle=0.5"}),
              ElementsAre(HasSubstr("friction_angle is in degrees")));
  EXPECT_THAT(warnings(sample(), {"contact.friction_angle=0"}), IsEmpty());
  EXPECT_THAT(warnings(sample(), {"contact.friction_angle=1"}), IsEmpty());
}

TEST(ImplausibleKeys, NoFrictionAnywhere) {
  EXPECT_THAT(warnings(sample_with(5, "")), ElementsAre(HasSubstr(":4:2: warning: no friction anywhere")));
  EXPECT_THAT(warnings(sample_with(5, "friction_angle = 0")), IsEmpty());
  EXPECT_THAT(warnings(sample_with(5, ""), {"joint.0.friction_angle=20"}), IsEmpty());
}

TEST(ImplausibleKeys, GravityUpwards) {
  EXPECT_THAT(warnings(sample(), {"analysis.gravity=[0, 0, 9.81]"}),
              ElementsAre(HasSubstr("warning: gravity points upwards ([0, 0, 9.81])")));
  EXPECT_THAT(warnings(sample(), {"analysis.gravity=[9.81, 0, 1]"}), IsEmpty());
  // A history counts by its start. A later reversal is a tilt.
  EXPECT_THAT(warnings(sample(), {"analysis.gravity_history=[[0, 0, 0, 9.81], [1, 0, 0, -9.81]]"}),
              ElementsAre(HasSubstr("warning: gravity points upwards ([0, 0, 9.81])")));
  EXPECT_THAT(warnings(sample(), {"analysis.gravity_history=[[0, 0, 0, -9.81], [1, 0, 0, 9.81]]"}),
              IsEmpty());
}

TEST(ImplausibleKeys, MeshesInMillimetres) {
  const std::string scan =
      "[[block]]\nname = \"scan\"\nmaterial = \"rock\"\nmesh = { file = \"scan.off\" }\n";
  EXPECT_THAT(warnings(sample() + scan),
              ElementsAre(HasSubstr("warning: block \"scan\" is 800 m wide, 2e+02 times the widest")));
  std::string scaled = scan;
  scaled.insert(scaled.find(" }"), ", scale = 1");
  EXPECT_THAT(warnings(sample() + scaled), IsEmpty());
}

TEST(ImplausibleKeys, AVelocityThatIsASlipIsNamedAsOne) {
  EXPECT_THAT(warnings(sample(), {"block.A.velocity=[0, 0, -1e4]", "analysis.time_step=1e-5"}),
              ElementsAre(HasSubstr(
                  "--set block.A.velocity=[0, 0, -1e4]: warning: velocity is large (1e+04 m/s at the "
                  "fastest point of block \"A\")")));
}

TEST(ImplausibleKeys, TiesUnderStressOfTheGround) {
  const auto told = [](const std::string& overrides) {
    return warnings(sample() + "[initial_stress]\nk0 = 0.5\nsurface = 10\n",
                    {"joint.0.tied=true", overrides});
  };
  const auto ties = HasSubstr("ties begin without the stress of the ground");
  EXPECT_THAT(told("analysis.initial_state=\"as-placed\""), ::testing::Contains(ties));
  EXPECT_THAT(told("analysis.initial_state=\"static\""), ::testing::Not(::testing::Contains(ties)));
}

}  // namespace
}  // namespace ashlar::test::implausible_keys_test
