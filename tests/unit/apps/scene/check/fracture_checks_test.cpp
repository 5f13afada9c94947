#include "apps/scene/check/fracture_checks.hpp"

#include <gmock/gmock.h>

#include "apps/scene/check/scene_checks.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "apps/scene/model/joint_table.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::fracture_checks_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

const std::string pair = "blocks = [\"A\", \"B*\"]\n";

std::vector<std::string> faults_of(const std::string& joint, const std::vector<std::string>& overrides = {}) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(sample_with(7, pair + joint), "s.toml", overrides, diagnostics);
  check_references(scene, diagnostics);
  return printed(diagnostics);
}

SceneJointLaw law_of(const std::string& joint) {
  Diagnostics diagnostics;
  return joint_law_between(parse_scene(sample_with(7, pair + joint), "s.toml", {}, diagnostics), "A", "B");
}

TEST(FractureChecks, ATieWithStrengthsIsABondOfThem) {
  EXPECT_THAT(faults_of("tied = { tension = 1e6, shear = 2e6 }"), IsEmpty());
  const SceneJointLaw law = law_of("tied = { tension = 1e6, shear = 2e6 }");
  EXPECT_FALSE(law.tied);
  ASSERT_TRUE(law.tie);
  EXPECT_EQ(law.tensile_strength, 1e6);
  EXPECT_EQ(law.cohesion, 2e6);
  EXPECT_EQ(law.friction_angle, 30.0);
  // A later joint unties.
  const SceneJointLaw untied =
      law_of("tied = { tension = 1e6, shear = 2e6 }\n[[joint]]\n" + pair + "tied = false");
  EXPECT_FALSE(untied.tie);
  EXPECT_TRUE(law_of("tied = { tension = 1e6, shear = 2e6 }\n[[joint]]\n" + pair + "tied = true").tied);
}

TEST(FractureChecks, FaultsOfATieAreReportedAtItsKeys) {
  EXPECT_THAT(faults_of("tied = { tension = 1e6 }"), ElementsAre(HasSubstr("missing key (shear)")));
  EXPECT_THAT(faults_of("tied = { tension = 0, shear = 1 }"),
              ElementsAre(StartsWith("s.toml:8:20: error: tension is out of range (0)")));
  EXPECT_THAT(faults_of("tied = {}"),
              ElementsAre(HasSubstr("true or false or { tension, shear } is needed")));
  EXPECT_THAT(faults_of("tied = { tension = 1, shear = 1 }\ncohesion = 2"),
              ElementsAre(StartsWith("s.toml:9:1: error: cohesion beside the strength of a tie")));
  for (const char* points : {"contact.springs=point", "analysis.formulation=paper"})
    EXPECT_THAT(
        faults_of("tied = { tension = 1, shear = 1 }", {points}),
        ElementsAre(StartsWith("s.toml:8:1: error: point springs (springs = \"point\", or formulation = "
                               "\"paper\") with a bond per area")))
        << points;
}

TEST(FractureChecks, EachStrengthNeedsItsEnergyAndSpringsThatHoldLess) {
  const std::string both = "tensile_strength = 1e5\ncohesion = 2e5\n";
  const std::string energies = "fracture_energy = { tension = 50, shear = 200 }";
  EXPECT_THAT(faults_of(both + energies), IsEmpty());
  EXPECT_THAT(faults_of("tied = { tension = 1e5, shear = 2e5 }\n" + energies), IsEmpty());
  EXPECT_THAT(faults_of(both + "fracture_energy = { tension = 50 }"),
              ElementsAre(StartsWith(
                  "s.toml:10:1: error: fracture_energy.shear is missing (cohesion is 200000 Pa)")));
  EXPECT_THAT(faults_of("tensile_strength = 1e5\n" + energies),
              ElementsAre(HasSubstr("fracture_energy.shear without cohesion (200 J/m^2), a cohesion > 0")));
  // T^2/(2 G) = 1e8 Pa/m, c^2/(2 G) = 1e8 Pa/m.
  EXPECT_THAT(
      faults_of(both + energies + "\nnormal_stiffness = 1e8\nshear_stiffness = 1.01e8"),
      ElementsAre(StartsWith("s.toml:11:1: error: normal_stiffness is too small for the fracture energy "
                             "(100000000 Pa/m)")));
  for (const char* excluded : {"dilation_angle = 5", "damping = 0.1", "cohesion_residual = 1",
                               "tensile_strength_residual = 1", "friction_angle_residual = 10"})
    EXPECT_THAT(faults_of(both + energies + "\n" + excluded),
                ElementsAre(HasSubstr("beside fracture_energy (both given)")))
        << excluded;
}

TEST(FractureChecks, TheLawOfAJointIsOverTheBondOfItsCut) {
  Scene scene;
  scene.contact.law.friction_angle = 30.0;
  SceneJoint bond;
  bond.cut = "cells";
  bond.made_by_cut = true;
  bond.tie = SceneTie{1e6, 2e6};
  bond.fracture_energy = FractureEnergy{};  // brittle
  SceneJoint same_cut, other_cut;
  same_cut.cut = "cells";
  same_cut.tensile_strength = 5e5;
  other_cut.cut = "bedding";
  other_cut.cohesion = 7.0;
  scene.joint = {bond, same_cut, other_cut};
  const SceneJointLaw of_bond = law_with_joint(scene, 0);
  EXPECT_EQ(of_bond.tensile_strength, 1e6);
  EXPECT_FALSE(of_bond.fracture_energy);
  const SceneJointLaw changed = law_with_joint(scene, 1);
  EXPECT_EQ(changed.tensile_strength, 5e5);
  EXPECT_EQ(changed.cohesion, 2e6);
  EXPECT_EQ(changed.friction_angle, 30.0);
  EXPECT_FALSE(changed.fracture_energy);
  const SceneJointLaw other = law_with_joint(scene, 2);
  EXPECT_EQ(other.tensile_strength, 0.0);
  EXPECT_EQ(other.cohesion, 7.0);
}

TEST(FractureChecks, RestitutionIsAShare) {
  EXPECT_THAT(faults_of("restitution = 0.5"), IsEmpty());
  EXPECT_THAT(faults_of("restitution = 1.5"), ElementsAre(StartsWith("s.toml:8:15: error: restitution")));
}

TEST(FractureChecks, KeysAreWrittenAsTheyWereRead) {
  Diagnostics diagnostics;
  const std::string joint =
      "restitution = 0.5\nfracture_energy = { tension = 50, shear = 200 }\ntied = { tension = 1e5, shear = "
      "2e5 }";
  const Scene scene = parse_scene(sample_with(7, pair + joint), "s.toml", {}, diagnostics);
  const auto json = to_json(scene);
  EXPECT_EQ(json["joint"][0]["restitution"], 0.5);
  EXPECT_EQ(json["joint"][0]["fracture_energy"]["shear"], 200.0);
  EXPECT_EQ(json["joint"][0]["tied"]["tension"], 1e5);
  EXPECT_FALSE(json["contact"].contains("restitution"));
}

}  // namespace
}  // namespace ashlar::test::fracture_checks_test
