// Cuts with `bonded`: the joint of their faces, and what overrides it.
#include <gmock/gmock.h>

#include <cmath>

#include "apps/scene/assemble/build_simulation.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "apps/scene/model/joint_table.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/scene/expand/sample_rock.hpp"

namespace ashlar::test::bonded_cuts_test {
namespace {

using ::testing::HasSubstr;

const std::string along_x = "[[cut]]\nname = \"x\"\nblocks = [\"rock\"]\ndip = 90\ndip_direction = 90\n";
const std::string along_z = "[[cut]]\nname = \"z\"\nblocks = [\"rock\"]\ndip = 0\ndip_direction = 0\n";

struct Outcome {
  std::optional<LoadedScene> loaded;
  std::string text;
};

Outcome load(const std::string& more, const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  write_text(folder / "s.toml", rock_scene + more);
  Diagnostics diagnostics;
  Outcome outcome;
  outcome.loaded = load_scene(folder / "s.toml", overrides, diagnostics);
  for (Diagnostic fault : diagnostics.sorted()) {
    fault.place.origin = "s.toml";
    outcome.text += to_string(fault) + "\n";
  }
  return outcome;
}

// In line 23 after along_x and a point.
const std::string bond =
    "bonded = { tensile_strength = 1e6, cohesion = 3e6, friction_angle = 40, fracture_energy = 50 }\n";

TEST(BondedCuts, BondedCutBondsItsFacesWithTheSpringsOfATie) {
  const Outcome outcome = load(along_x + "point = [1, 0, 0]\n" + bond + along_z + "point = [0, 0, 1]\n");
  ASSERT_TRUE(outcome.loaded) << outcome.text;
  EXPECT_EQ(outcome.text, "");
  const JointTable table(outcome.loaded->scene);
  const SceneJointLaw law = table.law_between(1, 3);
  EXPECT_TRUE(law.tie);
  EXPECT_EQ(law.tensile_strength, 1e6);
  EXPECT_EQ(law.cohesion, 3e6);
  EXPECT_EQ(law.friction_angle, 40.0);
  EXPECT_EQ(law.fracture_energy, (FractureEnergy{50.0, 50.0}));
  EXPECT_FALSE(table.law_between(1, 2).tie) << "of the other cut";
  EXPECT_FALSE(table.law_between(0, 1).tie) << "the ground was not cut";
  const auto json = to_json(outcome.loaded->scene);
  EXPECT_FALSE(json.contains("joint")) << "the scene as it was written";
  EXPECT_EQ(json.at("cut")[0].at("bonded").at("cohesion"), 3e6);
  Diagnostics diagnostics;
  const auto built = build_simulation(*outcome.loaded, 1, diagnostics);
  ASSERT_TRUE(built);
  EXPECT_TRUE(diagnostics.good());
  EXPECT_TRUE(built->simulation.system().ties().empty());
  const JointLaw bonded = built->simulation.system().law(1, 3);
  // 1e5 E/size of quarters of 2 m^3: a hundred thousandth of their compliance. T^2/(2 G) = 1e10 Pa/m is less.
  const double stiffness = 1e5 * 1e9 / std::cbrt(2.0);
  EXPECT_NEAR(bonded.normal_stiffness, stiffness, 1e-9 * stiffness);
  EXPECT_NEAR(bonded.shear_stiffness, stiffness, 1e-9 * stiffness);
  EXPECT_EQ(bonded.fracture, (FractureEnergy{50.0, 50.0}));
  EXPECT_EQ(bonded.residual->cohesion, 0.0);
  EXPECT_EQ(bonded.residual->friction, bonded.friction);
}

TEST(BondedCuts, ABondHasNoStiffnessOrDilationOfContact) {
  for (const bool brittle : {false, true}) {
    const std::string key = brittle ? "bonded = { tensile_strength = 1e6, cohesion = 3e6 }\n" : bond;
    const Outcome outcome = load(along_x + "point = [1, 0, 0]\n" + key,
                                 {"contact.normal_stiffness=1e10", "contact.dilation_angle=5",
                                  "contact.damping=0.1", "contact.friction_angle_residual=20"});
    ASSERT_TRUE(outcome.loaded) << outcome.text;
    const SceneJointLaw law = JointTable(outcome.loaded->scene).law_between(1, 2);
    EXPECT_FALSE(law.gives_stiffness());
    EXPECT_EQ(law.dilation_angle, 0.0);
    EXPECT_EQ(law.damping, 0.0);
    EXPECT_EQ(law.friction_angle_residual, brittle ? 30.0 : 40.0) << "that of the bond";
  }
  const Outcome brittle =
      load(along_x + "point = [1, 0, 0]\nbonded = { tensile_strength = 1e6, cohesion = 3e6 }\n",
           {"contact.cohesion=1e5", "contact.tensile_strength=1e5",
            "contact.fracture_energy={ tension = 10, shear = 10 }"});
  ASSERT_TRUE(brittle.loaded) << brittle.text;
  EXPECT_FALSE(JointTable(brittle.loaded->scene).law_between(1, 2).fracture_energy->given());
}

TEST(BondedCuts, LaterJointsOverrideABondKeyByKey) {
  const std::string bonded = along_x + "point = [1, 0, 0]\n" + bond;
  const Outcome outcome =
      load(bonded +
           "[[joint]]\ncut = \"x\"\ntensile_strength = 5e5\nfracture_energy = { tension = "
           "10, shear = 20 }\n[[joint]]\nblocks = [\"ground\", \"rock*\"]\ncohesion = 7\n");
  ASSERT_TRUE(outcome.loaded) << outcome.text;
  EXPECT_EQ(outcome.text, "");
  const JointTable table(outcome.loaded->scene);
  const SceneJointLaw law = table.law_between(1, 2);
  EXPECT_TRUE(law.tie);
  EXPECT_EQ(law.tensile_strength, 5e5);
  EXPECT_EQ(law.cohesion, 3e6);
  EXPECT_EQ(law.fracture_energy, (FractureEnergy{10.0, 20.0}));
  EXPECT_EQ(table.law_between(0, 1).cohesion, 7.0);
  EXPECT_EQ(outcome.loaded->scene.places.value("joint.1.tensile_strength").line, 26);
  EXPECT_EQ(outcome.loaded->scene.places.key("joint.0.cohesion").line, 23) << "of the bond";
  EXPECT_EQ(to_json(outcome.loaded->scene).at("joint").size(), 2U);
}

TEST(BondedCuts, FaultsOfABondHaveTheirPlaces) {
  const std::string bonded = along_x + "point = [1, 0, 0]\n" + bond;
  for (const auto& [scene, fault] : std::vector<std::pair<std::string, std::string>>{
           {along_x + "point = [2, 0, 0]\n" + bond,
            "s.toml:23:1: error: bonded cut makes no face between two blocks (\"x\"), a cut that divides a "
            "block is needed\n"},
           {bonded + "[[joint]]\ncut = \"x\"\ntied = true\n",
            "s.toml:26:1: error: tied beside bonded of cut \"x\" (both between blocks \"rock.1\" and "
            "\"rock.2\"), only one of both is allowed\n"},
           {bonded + "[[joint]]\nblocks = [\"*\", \"*\"]\ntied = { tension = 1, shear = 1 }\n",
            "s.toml:26:1: error: tied beside bonded of cut \"x\" (both between blocks \"rock.1\" and "
            "\"rock.2\"), only one of both is allowed\n"},
           {bonded + "[[joint]]\ncut = \"x\"\nfriction_angle_residual = 50\n",
            "s.toml:26:27: error: friction_angle_residual is above friction_angle (50 degrees), at most 40 "
            "degrees is allowed\n"},
           {bonded + "[[joint]]\ncut = \"x\"\nnormal_stiffness = 1e10\n",
            "s.toml:26:1: error: normal_stiffness is too small for the fracture energy (10000000000 Pa/m)"}})
    EXPECT_THAT(load(scene).text, HasSubstr(fault)) << scene;
  EXPECT_THAT(
      load(bonded, {"contact.springs=point"}).text,
      HasSubstr("s.toml:23:73: error: point springs (springs = \"point\", or formulation = \"paper\") "
                "with a bond per area"));
  // A tie of other blocks is none of the bond's.
  const Outcome ground = load(bonded + "[[joint]]\nblocks = [\"ground\", \"rock*\"]\ntied = true\n");
  EXPECT_EQ(ground.text, "");
}

}  // namespace
}  // namespace ashlar::test::bonded_cuts_test
