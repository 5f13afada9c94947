#include "apps/scene/available_features.hpp"

#include <gmock/gmock.h>

#include "unit/apps/sample_scene.hpp"

namespace ashlar::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::vector<std::string> refused(const std::string& text) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(text, "s.toml", {}, diagnostics);
  check_availability(scene, diagnostics);
  return printed(diagnostics);
}

TEST(AvailableFeatures, DefaultsAreAvailable) {
  EXPECT_THAT(refused(sample()), IsEmpty());
}

class UnavailableFeature : public ::testing::TestWithParam<FaultCase> {};

TEST_P(UnavailableFeature, IsRefusedByNameAtItsPlace) {
  const FaultCase& fault = GetParam();
  EXPECT_THAT(refused(sample_with(fault.line, fault.replacement)), ElementsAre(StartsWith(fault.expected)));
}

INSTANTIATE_TEST_SUITE_P(All, UnavailableFeature,
                         ::testing::Values(FaultCase{1, "[analysis]\nsolver = \"cg\"",
                                                     "s.toml:2:10: error: not available in this version"}));

TEST(AvailableFeatures, WhatIsAvailableMayBeGiven) {
  EXPECT_THAT(refused(sample_with(1,
                                  "[analysis]\ntype = \"static\"\nintegrator = \"generalized-alpha\"\n"
                                  "formulation = \"incremental\"\nsolver = \"cholmod\"\nmass_damping = 0.1")),
              IsEmpty());
  EXPECT_THAT(refused(sample_with(22, "point = [0, 0, 0]\ndisplacement_history = [[0, 0, 0, 0]]")),
              IsEmpty());
}

TEST(AvailableFeatures, FaultyValuesAreNotRefusedAgain) {
  EXPECT_THAT(refused(sample_with(22, "point = [0, 0, 0]\ndisplacement_history = [[0]]")),
              ElementsAre(StartsWith("s.toml:23:25: error: displacement_history has the wrong length")));
  EXPECT_THAT(refused(sample_with(5, "augmented = 1")),
              ElementsAre(StartsWith("s.toml:5:13: error: augmented has the wrong type")));
}

}  // namespace
}  // namespace ashlar::test
