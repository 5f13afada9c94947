#include "apps/scene/keys/scene_keys.hpp"

#include <gmock/gmock.h>

#include "apps/scene/json/scene_json.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::cut_keys_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The sample with a cut, whose further keys start in line 37.
std::string with_cut(const std::string& more) {
  return sample() + "[[cut]]\nname = \"c\"\nblocks = [\"A\"]\ndip = 0\ndip_direction = 0\n" + more + "\n";
}

Scene scene_with_cut(const std::string& more) {
  Diagnostics diagnostics;
  Scene scene = parse_scene(with_cut(more), "s.toml", {}, diagnostics);
  EXPECT_THAT(printed(diagnostics), IsEmpty());
  return scene;
}

TEST(CutKeys, ReadsABond) {
  const Scene scene = scene_with_cut(
      "bonded = { tensile_strength = 1e6, cohesion = 3e6, friction_angle = 40, fracture_energy = { tension = "
      "50, shear = 200 } }");
  ASSERT_TRUE(scene.cut[0].bonded);
  const SceneBond& bond = *scene.cut[0].bonded;
  EXPECT_EQ(bond.tensile_strength, 1e6);
  EXPECT_EQ(bond.cohesion, 3e6);
  EXPECT_EQ(bond.friction_angle, 40.0);
  EXPECT_EQ(bond.fracture_energy, (FractureEnergy{50.0, 200.0}));
  EXPECT_FALSE(scene.cut[0].glued);
}

TEST(CutKeys, ANumberIsTheFractureEnergyOfBothKinds) {
  const Scene scene =
      scene_with_cut("bonded = { tensile_strength = 1e6, cohesion = 3e6, fracture_energy = 50 }");
  EXPECT_EQ(scene.cut[0].bonded->fracture_energy, (FractureEnergy{50.0, 50.0}));
  EXPECT_FALSE(scene.cut[0].bonded->friction_angle);
  const Scene brittle = scene_with_cut("bonded = { tensile_strength = 1e6, cohesion = 3e6 }");
  EXPECT_FALSE(brittle.cut[0].bonded->fracture_energy);
  EXPECT_FALSE(scene_with_cut("").cut[0].bonded);
}

TEST(CutKeys, ABondIsWrittenAsItWasRead) {
  const auto json = to_json(scene_with_cut(
      "bonded = { tensile_strength = 1e6, cohesion = 3e6, friction_angle = 40, fracture_energy = 50 }"));
  EXPECT_EQ(json.at("cut")[0].at("bonded"), nlohmann::ordered_json::parse(R"({
    "tensile_strength": 1e6, "cohesion": 3e6, "friction_angle": 40.0,
    "fracture_energy": {"tension": 50.0, "shear": 50.0}})"));
  const auto brittle = to_json(scene_with_cut("bonded = { tensile_strength = 1e6, cohesion = 3e6 }"));
  EXPECT_EQ(brittle.at("cut")[0].at("bonded"),
            nlohmann::ordered_json::parse(R"({"tensile_strength": 1e6, "cohesion": 3e6})"));
  EXPECT_FALSE(to_json(scene_with_cut("")).at("cut")[0].contains("bonded"));
}

TEST(CutKeys, FaultsOfABondAreReportedAtItsKeys) {
  const std::string strengths = "bonded = { tensile_strength = 1, cohesion = 1, ";
  for (const auto& [more, fault] : std::vector<std::pair<std::string, std::string>>{
           {"bonded = 5", "s.toml:37:10: error: bonded has the wrong type (5), a table is needed"},
           {"bonded = { tensile_strength = 1 }",
            "s.toml:37:1: error: missing key (cohesion), cut.bonded needs it"},
           {"bonded = { cohesion = 1 }",
            "s.toml:37:1: error: missing key (tensile_strength), cut.bonded needs it"},
           {"bonded = { tensile_strength = 0, cohesion = 1 }",
            "s.toml:37:31: error: tensile_strength is out of range (0), a number > 0 is needed"},
           {"bonded = { tensile_strength = 1, cohesion = -1 }",
            "s.toml:37:45: error: cohesion is out of range (-1), a number > 0 is needed"},
           {strengths + "friction_angle = 90 }",
            "s.toml:37:65: error: friction_angle is out of range (90), a number of degrees >= 0 and < 90 is "
            "needed"},
           {strengths + "fracture_energy = \"a\" }",
            "s.toml:37:66: error: fracture_energy has the wrong type (\"a\"), a number > 0 or { tension, "
            "shear } is needed"},
           {strengths + "fracture_energy = { tension = 1 } }",
            "s.toml:37:48: error: missing key (shear), cut.bonded.fracture_energy needs it"},
           {"glued = true\nbonded = { tensile_strength = 1, cohesion = 1 }",
            "s.toml:38:1: error: bonded beside glued (both given), only one of both is allowed"}})
    EXPECT_THAT(reading_faults(with_cut(more)), ElementsAre(fault)) << more;
}

}  // namespace
}  // namespace ashlar::test::cut_keys_test
