#include "apps/scene/check/roughness_checks.hpp"

#include <gmock/gmock.h>

#include "unit/apps/scene/check/faults_of_joints.hpp"

namespace ashlar::test::roughness_checks_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// @param contact lines of [contact]
std::vector<std::string> faults_of(const std::string& contact) {
  return faults_of_joints(check_roughness, 5, contact);
}

const std::string rough = "roughness = { jrc = 8, jcs = 5e7, length = 0.5 }\n";

TEST(RoughnessChecks, ARoughJointHasFrictionCohesionAndDilation) {
  EXPECT_THAT(faults_of(rough), IsEmpty());
  EXPECT_THAT(faults_of(rough + "cohesion = 1e4\ndilation_angle = 5"), IsEmpty());
}

TEST(RoughnessChecks, OtherStrengthsAreRefused) {
  EXPECT_THAT(faults_of(rough + "friction_angle_residual = 5"),
              ElementsAre(StartsWith("s.toml:6:1: error: friction_angle_residual beside roughness; ")));
  EXPECT_THAT(faults_of(rough + "compressive_strength = 1e6"),
              ElementsAre(StartsWith("s.toml:6:1: error: compressive_strength beside roughness; ")));
}

TEST(RoughnessChecks, EntriesThatMatchTheSameBlocksCountTogether) {
  const std::string joints =
      "blocks = [\"A\", \"B\"]\n" + rough +
      "[[joint]]\nblocks = [\"*\", \"B\"]\nfracture_energy = { tension = 1, shear = 1 }";
  EXPECT_THAT(faults_of_joints(check_roughness, 7, joints),
              ElementsAre(StartsWith("s.toml:11:1: error: fracture_energy beside roughness; ")));
}

TEST(RoughnessChecks, PointSpringsHaveNoPressure) {
  EXPECT_THAT(faults_of(rough + "springs = \"point\""),
              ElementsAre(StartsWith("s.toml:5:1: error: roughness with point springs, ")));
}

TEST(RoughnessChecks, NumbersOutOfRangeAreReportedAtTheirPlace) {
  EXPECT_THAT(faults_of("roughness = { jrc = 25, jcs = 5e7 }"),
              ElementsAre(StartsWith("s.toml:5:21: error: jrc is out of range (25)")));
  EXPECT_THAT(faults_of("roughness = { jrc = 8 }"), ElementsAre(StartsWith("s.toml:5:")));
}

}  // namespace
}  // namespace ashlar::test::roughness_checks_test
