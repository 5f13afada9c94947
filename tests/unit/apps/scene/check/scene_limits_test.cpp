#include "apps/scene/check/scene_limits.hpp"

#include <gmock/gmock.h>

#include "apps/scene/expand/scene_solids.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::scene_limits_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

// Coordinates up to 4 m, block A of size 1 m, time_step 0.01 s of 1 s.
std::vector<std::string> faults(const std::string& text, const std::vector<std::string>& overrides = {}) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(text, "s.toml", overrides, diagnostics);
  check_limits(ExpandedScene(scene), build_solids(scene, diagnostics), diagnostics);
  return printed(diagnostics);
}

class SceneLimitsFault : public ::testing::TestWithParam<FaultCase> {};

TEST_P(SceneLimitsFault, IsReportedOnceAtItsPlace) {
  const FaultCase& fault = GetParam();
  EXPECT_THAT(faults(sample_with(fault.line, fault.replacement)), ElementsAre(StartsWith(fault.expected)));
}

INSTANTIATE_TEST_SUITE_P(
    Every, SceneLimitsFault,
    ::testing::Values(
        // 4 m times 2^-52
        FaultCase{5, "distance = 8e-16",
                  "s.toml:5:12: error: distance is less than coordinates are rounded to (8e-16 m), at least "
                  "8.882e-16 m is needed"},
        FaultCase{
            5, "augmented = true\npenetration_tolerance = 1e-300",
            "s.toml:6:25: error: penetration_tolerance is less than coordinates are rounded to (1e-300 m)"},
        FaultCase{3, "time_step = 5e-324", "s.toml:3:13: error: time_step is less than times are rounded to"},
        FaultCase{
            15, "material = \"rock\"\nvelocity = [0, 5e5, 0]",
            "s.toml:16:12: error: velocity is too large for this time_step (5e+05 m/s), at most 4.096e+05 "
            "m/s is allowed"},
        FaultCase{
            15, "material = \"rock\"\nangular_velocity = [0, 0, 1e300]",
            "s.toml:16:20: error: angular_velocity is too large for this time_step (1e+300 rad/s), at most "
            "4.096e+05 rad/s is allowed"},
        FaultCase{
            22, "point = [0, 0, 0]\ndisplacement_history = [[0, 0, 0, 0], [1, 0, 0, -1e10]]",
            "s.toml:23:24: error: displacement_history moves the block beyond the range of double precision "
            "(1e+10 m), at most 7.149e+09 m is allowed"}));

TEST(SceneLimits, WhatDoublesCanFollowIsGood) {
  EXPECT_THAT(faults(sample()), IsEmpty());
  EXPECT_THAT(faults(sample_with(5, "distance = 9e-16"),
                     {"block.A.velocity=[4e5, 0, 0]", "block.A.angular_velocity=[4e5, 0, 0]"}),
              IsEmpty());
  EXPECT_THAT(faults(sample(), {"analysis.type=static", "block.A.velocity=[1e9, 0, 0]"}), IsEmpty());
}

}  // namespace
}  // namespace ashlar::test::scene_limits_test
