#include "apps/scene/check/joint_rules.hpp"

#include <gmock/gmock.h>

#include "unit/apps/scene/check/faults_of_joints.hpp"

namespace ashlar::test::joint_rules_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// @param contact lines of [contact]
std::vector<std::string> faults_of(const std::string& contact) {
  return faults_of_joints(check_joint_rules, 5, contact);
}

const std::string rough = "roughness = { jrc = 8, jcs = 5e7, length = 0.5 }\n";

TEST(RulesOfRoughJoints, ARoughJointHasFrictionCohesionAndDilation) {
  EXPECT_THAT(faults_of(rough), IsEmpty());
  EXPECT_THAT(faults_of(rough + "cohesion = 1e4\ndilation_angle = 5"), IsEmpty());
}

TEST(RulesOfRoughJoints, OtherStrengthsAreRefused) {
  EXPECT_THAT(faults_of(rough + "friction_angle_residual = 5"),
              ElementsAre(StartsWith("s.toml:6:1: error: friction_angle_residual beside roughness; ")));
  EXPECT_THAT(faults_of(rough + "compressive_strength = 1e6"),
              ElementsAre(StartsWith("s.toml:6:1: error: compressive_strength beside roughness; ")));
}

TEST(RulesOfRoughJoints, EntriesThatMatchTheSameBlocksCountTogether) {
  const std::string joints =
      "blocks = [\"A\", \"B\"]\n" + rough +
      "[[joint]]\nblocks = [\"*\", \"B\"]\nfracture_energy = { tension = 1, shear = 1 }";
  EXPECT_THAT(faults_of_joints(check_joint_rules, 7, joints),
              ElementsAre(StartsWith("s.toml:11:1: error: fracture_energy beside roughness; ")));
}

TEST(RulesOfRoughJoints, PointSpringsHaveNoPressure) {
  EXPECT_THAT(faults_of(rough + "springs = \"point\""),
              ElementsAre(StartsWith("s.toml:5:1: error: roughness with point springs, ")));
}

TEST(RulesOfRoughJoints, NumbersOutOfRangeAreReportedAtTheirPlace) {
  EXPECT_THAT(faults_of("roughness = { jrc = 25, jcs = 5e7 }"),
              ElementsAre(StartsWith("s.toml:5:21: error: jrc is out of range (25)")));
  EXPECT_THAT(faults_of("roughness = { jrc = 8 }"), ElementsAre(StartsWith("s.toml:5:")));
}

const std::string crushing = "compressive_strength = 1e6\n";

TEST(RulesOfCrushingJoints, TensionIsAtMostTheCompressiveStrength) {
  EXPECT_THAT(faults_of(crushing + "tensile_strength = 1e6"), IsEmpty());
  EXPECT_THAT(faults_of(crushing + "tensile_strength = 2e6"),
              ElementsAre(StartsWith("s.toml:5:24: error: compressive_strength is below tensile_strength "
                                     "(1000000 Pa, 2000000 Pa), at least 2000000 Pa is needed")));
}

TEST(RulesOfCrushingJoints, SpringsThatCrushHaveNoOtherLaw) {
  EXPECT_THAT(faults_of(crushing + "dilation_angle = 5\ndamping = 0.1"),
              ElementsAre(StartsWith("s.toml:6:1: error: dilation_angle beside compressive_strength; "),
                          StartsWith("s.toml:7:1: error: damping beside compressive_strength; ")));
}

// Without a method, springs may decide.
TEST(RulesOfCrushingJoints, RigidBlocksOfLimitAnalysisHaveAllOfThem) {
  const auto faults_with = [](const std::string& analysis) {
    Diagnostics diagnostics;
    const std::string text =
        "[analysis]\n" + analysis + sample_with(5, crushing + "damping = 0.1").substr(11);
    const Scene scene = parse_scene(text, "s.toml", {}, diagnostics);
    check_joint_rules(scene, diagnostics);
    return printed(diagnostics);
  };
  EXPECT_THAT(faults_with("type = \"factor-of-safety\"\nmethod = \"limit\"\n"),
              ::testing::Not(::testing::Contains(::testing::HasSubstr("damping beside"))));
  for (const char* method : {"", "method = \"auto\"\n", "method = \"elastic\"\n"})
    EXPECT_THAT(faults_with(std::string("type = \"factor-of-safety\"\n") + method),
                ::testing::Contains(::testing::HasSubstr("damping beside")))
        << method;
}

const std::string closing = "maximum_closure = 3e-4\nnormal_stiffness = 1e10\n";

TEST(RulesOfClosingJoints, AJointThatStiffensHasFrictionRoughnessAndDilation) {
  EXPECT_THAT(faults_of(closing), IsEmpty());
  EXPECT_THAT(faults_of(closing + "roughness = { jrc = 8, jcs = 5e7 }\ndilation_angle = 5\ndamping = 0.1"),
              IsEmpty());
}

TEST(RulesOfClosingJoints, ItsInitialStiffnessIsNeeded) {
  EXPECT_THAT(faults_of("maximum_closure = 3e-4"),
              ElementsAre(StartsWith(
                  "s.toml:5:1: error: maximum_closure without normal_stiffness, a number is needed")));
  EXPECT_THAT(faults_of("maximum_closure = 3e-4\nnormal_stiffness = \"auto\"").size(), 1U);
}

TEST(RulesOfClosingJoints, BondsAndCrushingAreRefused) {
  EXPECT_THAT(faults_of(closing + "tensile_strength = 1e4"),
              ElementsAre(StartsWith("s.toml:7:1: error: tensile_strength beside maximum_closure; ")));
  EXPECT_THAT(faults_of(closing + "compressive_strength = 1e6"),
              ElementsAre(StartsWith("s.toml:7:1: error: compressive_strength beside maximum_closure; ")));
}

// Blocks A and B are matched by all entries, the sample's first.
TEST(RulesOfClosingJoints, EntriesThatMatchTheSameBlocksCountTogether) {
  const auto of_joints = [](const std::string& first, const std::string& second) {
    const std::string joints =
        "blocks = [\"A\", \"B\"]\n" + first + "\n[[joint]]\nblocks = [\"*\", \"*\"]\n" + second;
    return faults_of_joints(check_joint_rules, 7, joints);
  };
  const std::string curve = "normal_stiffness = 1e10\nmaximum_closure = 3e-4";
  EXPECT_THAT(of_joints(curve, "tensile_strength = 1e4"),
              ElementsAre(StartsWith("s.toml:12:1: error: tensile_strength beside maximum_closure; ")));
  EXPECT_THAT(of_joints("tensile_strength = 1e4", curve),
              ElementsAre(StartsWith("s.toml:12:1: error: tensile_strength beside maximum_closure; ")));
  EXPECT_THAT(of_joints(curve, "cohesion = 1e4"), IsEmpty());
  EXPECT_THAT(of_joints(curve, "normal_stiffness = 1e10\ntensile_strength = 1e4"), IsEmpty());
}

TEST(RulesOfClosingJoints, PointSpringsHaveNoPressure) {
  EXPECT_THAT(faults_of(closing + "springs = \"point\""),
              ElementsAre(StartsWith("s.toml:5:1: error: maximum_closure with point springs, ")));
}

TEST(RulesOfClosingJoints, AJointWithAStiffnessAloneIsLinear) {
  SceneJointLaw law;
  law.normal_stiffness = 1e10;
  law.maximum_closure = 3e-4;
  SceneJoint joint;
  joint.cohesion = 1e4;
  override_law(law, joint);
  EXPECT_EQ(law.maximum_closure, 3e-4);
  joint.normal_stiffness.emplace(2e10);
  override_law(law, joint);
  EXPECT_FALSE(law.maximum_closure);
  joint.maximum_closure = 1e-4;
  override_law(law, joint);
  EXPECT_EQ(law.maximum_closure, 1e-4);
}

}  // namespace
}  // namespace ashlar::test::joint_rules_test
