#include "apps/scene/check/closure_checks.hpp"

#include <gmock/gmock.h>

#include "unit/apps/scene/check/faults_of_joints.hpp"

namespace ashlar::test::closure_checks_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// @param contact lines of [contact]
std::vector<std::string> faults_of(const std::string& contact) {
  return faults_of_joints(check_closures, 5, contact);
}

const std::string closing = "maximum_closure = 3e-4\nnormal_stiffness = 1e10\n";

TEST(ClosureChecks, AJointThatStiffensHasFrictionRoughnessAndDilation) {
  EXPECT_THAT(faults_of(closing), IsEmpty());
  EXPECT_THAT(faults_of(closing + "roughness = { jrc = 8, jcs = 5e7 }\ndilation_angle = 5\ndamping = 0.1"),
              IsEmpty());
}

TEST(ClosureChecks, ItsInitialStiffnessIsNeeded) {
  EXPECT_THAT(faults_of("maximum_closure = 3e-4"),
              ElementsAre(StartsWith(
                  "s.toml:5:1: error: maximum_closure without normal_stiffness, a number is needed")));
  EXPECT_THAT(faults_of("maximum_closure = 3e-4\nnormal_stiffness = \"auto\"").size(), 1U);
}

TEST(ClosureChecks, BondsAndCrushingAreRefused) {
  EXPECT_THAT(faults_of(closing + "tensile_strength = 1e4"),
              ElementsAre(StartsWith("s.toml:7:1: error: tensile_strength beside maximum_closure; ")));
  EXPECT_THAT(faults_of(closing + "compressive_strength = 1e6"),
              ElementsAre(StartsWith("s.toml:7:1: error: compressive_strength beside maximum_closure; ")));
}

// Blocks A and B are matched by all entries, the sample's first.
TEST(ClosureChecks, EntriesThatMatchTheSameBlocksCountTogether) {
  const auto of_joints = [](const std::string& first, const std::string& second) {
    const std::string joints =
        "blocks = [\"A\", \"B\"]\n" + first + "\n[[joint]]\nblocks = [\"*\", \"*\"]\n" + second;
    return faults_of_joints(check_closures, 7, joints);
  };
  const std::string curve = "normal_stiffness = 1e10\nmaximum_closure = 3e-4";
  EXPECT_THAT(of_joints(curve, "tensile_strength = 1e4"),
              ElementsAre(StartsWith("s.toml:12:1: error: tensile_strength beside maximum_closure; ")));
  EXPECT_THAT(of_joints("tensile_strength = 1e4", curve),
              ElementsAre(StartsWith("s.toml:12:1: error: tensile_strength beside maximum_closure; ")));
  EXPECT_THAT(of_joints(curve, "cohesion = 1e4"), IsEmpty());
  EXPECT_THAT(of_joints(curve, "normal_stiffness = 1e10\ntensile_strength = 1e4"), IsEmpty());
}

TEST(ClosureChecks, PointSpringsHaveNoPressure) {
  EXPECT_THAT(faults_of(closing + "springs = \"point\""),
              ElementsAre(StartsWith("s.toml:5:1: error: maximum_closure with point springs, ")));
}

TEST(ClosureChecks, AJointWithAStiffnessAloneIsLinear) {
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
}  // namespace ashlar::test::closure_checks_test
