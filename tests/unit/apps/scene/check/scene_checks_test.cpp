#include "apps/scene/check/scene_checks.hpp"

#include <gmock/gmock.h>

#include "apps/scene/expand/scene_solids.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::scene_checks_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::vector<std::string> all_faults(const std::string& text, const std::vector<std::string>& overrides = {}) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(text, "s.toml", overrides, diagnostics);
  check_references(scene, diagnostics);
  check_placement(ExpandedScene(scene), build_solids(scene, diagnostics), diagnostics);
  return printed(diagnostics);
}

TEST(SceneChecks, SampleIsGood) {
  EXPECT_THAT(all_faults(sample()), IsEmpty());
}

TEST(SceneChecks, BlocksOfOrderZeroHaveNoSupportsAndNeedAnIntegratorThatMovesThem) {
  EXPECT_THAT(all_faults(sample(), {"block.A.order=0"}), IsEmpty());
  EXPECT_THAT(all_faults(sample(), {"block.B.order=0"}),
              ElementsAre(HasSubstr("a block of order 0 has no supports (\"B\")")));
  EXPECT_THAT(all_faults(sample(), {"block.A.order=0", "analysis.integrator=generalized-alpha"}),
              ElementsAre(HasSubstr("generalized-alpha does not move blocks of order 0 (\"A\")")));
}

class SceneCheckFault : public ::testing::TestWithParam<FaultCase> {};

TEST_P(SceneCheckFault, IsReportedOnceAtItsPlace) {
  const FaultCase& fault = GetParam();
  EXPECT_THAT(all_faults(sample_with(fault.line, fault.replacement)),
              ElementsAre(StartsWith(fault.expected)));
}

INSTANTIATE_TEST_SUITE_P(
    References, SceneCheckFault,
    ::testing::Values(
        FaultCase{3, "time_step = 2",
                  "s.toml:3:13: error: time_step is longer than the analysis (2), at most end_time (1)"},
        FaultCase{3, "time_step = 0.01\nintegrator = \"generalized-alpha\"\nmass_damping = 301",
                  "s.toml:5:16: error: mass_damping is too large for this time_step with generalized-alpha "
                  "(301), at most 3 / time_step = 300 is allowed"},
        FaultCase{7, "blocks = [\"A\", \"C\"]",
                  "s.toml:7:10: error: joint names no block (\"C\"), the name of a [[block]] or a glob"},
        FaultCase{7, "blocks = [\"\", \"\"]", "s.toml:7:10: error: joint names no block (\"\")"},
        FaultCase{7, "blocks = [\"A\", \"wall*\"]", "s.toml:7:10: error: joint names no block (\"wall*\")"},
        FaultCase{7, "blocks = [\"A\", \"A\"]",
                  "s.toml:7:10: error: joint between a block and itself (\"A\", \"A\")"},
        FaultCase{
            5, "friction_angle = 30\ndilation_angle = 31",
            "s.toml:6:18: error: dilation_angle is above friction_angle (31 degrees), at most 30 degrees"},
        FaultCase{
            7, "blocks = [\"A\", \"B*\"]\ndilation_angle = 20\nfriction_angle_residual = 10",
            "s.toml:8:18: error: dilation_angle is above friction_angle_residual (20 degrees), at most 10"},
        FaultCase{
            5,
            "friction_angle = 30\ndilation_angle = 10\n[[joint]]\nblocks = [\"A\", \"B\"]\ncohesion = 1\n"
            "friction_angle = 5",
            "s.toml:10:18: error: dilation_angle is above friction_angle (10 degrees), at most 5 degrees"},
        FaultCase{15, "",
                  "s.toml:13:1: error: missing key (material), block \"A\" has none, one of \"rock\" is "
                  "needed"},
        FaultCase{15, "material = 3", "s.toml:15:12: error: material has the wrong type (3)"},
        FaultCase{15, "material = \"rok\"",
                  "s.toml:15:12: error: unknown material (\"rok\"), did you mean \"rock\"?"},
        FaultCase{28, "block = \"D\"",
                  "s.toml:28:9: error: unknown block (\"D\"), the name of a [[block]] is needed"},
        FaultCase{27, "name = \"momentum\"", "s.toml:27:8: error: measure name is taken (\"momentum\")"},
        FaultCase{
            8,
            "[[material]]\nname = \"rock\"\ndensity = 1\nyoung_modulus = 1\npoisson_ratio = 0\n[[material]]",
            "s.toml:14:8: error: material named twice (\"rock\", first at s.toml:9:8)"},
        FaultCase{30, "[[measure]]\nname = \"tip\"\nblock = \"A\"\npoint = [0, 0, 1]\n[output]",
                  "s.toml:31:8: error: measure named twice (\"tip\", first at s.toml:27:8)"},
        FaultCase{26, "[[block]]\nname = \"A\"\nfixed = true\nsphere = { radius = 1 }\n[[measure]]",
                  "s.toml:27:8: error: block named twice (\"A\", first at s.toml:14:8)"}));

INSTANTIATE_TEST_SUITE_P(
    Placement, SceneCheckFault,
    ::testing::Values(FaultCase{29, "point = [4.1, 0.5, 0.5]",
                                "s.toml:29:9: error: point is not in block \"B\" ([4.1, 0.5, 0.5])"},
                      FaultCase{22, "plane = { point = [1, 0, 0], normal = [-1, 0, 0] }",
                                "s.toml:22:9: error: no face of block \"B\" lies in the plane (point [1, 0, "
                                "0], normal [-1, 0, 0])"},
                      FaultCase{22, "plane = { point = [0, 0, 0], normal = [-1, 1, 0] }",
                                "s.toml:22:9: error: no face of block \"B\""},
                      FaultCase{22, "point = [0, -1, 0]", "s.toml:22:9: error: point is not in block \"B\""},
                      FaultCase{20, "box = { min = [0, 0, 0], max = [4, 1, 1] }\ntranslate = [0, 0, -1]",
                                "s.toml:30:9: error: point is not in block \"B\""},
                      FaultCase{25, "force = [0, 0, 1]\n[[block.load]]\npoint = [5, 0, 0]\nforce = [0, 0, 1]",
                                "s.toml:27:9: error: point is not in block \"B\""}));

TEST(SceneChecks, PlaneOfTooFewDigitsIsToldTheNearestFace) {
  // A beam of 4 x 1 x 1 m, turned by a half turn about z into x from -4 to 0: its diagonal is 4.2 m. The
  // plane leans by 0.001 over the 1 m of the face at x = -4.
  EXPECT_THAT(
      all_faults(sample_with(20,
                             "box = { min = [0, 0, 0], max = [4, 1, 1] }\n"
                             "rotate = { axis = [0, 0, 1], angle = 180, about = [0, 0.5, 0] }"),
                 {"measure.0.point=[-1, 0, 0]", "block.B.load=[]",
                  "block.B.fix.0.plane={ point = [-4, 0, 0], normal = [1, 0, 0.001] }"}),
      ElementsAre(
          "--set block.B.fix.0.plane={ point = [-4, 0, 0], normal = [1, 0, 0.001] }: error: no face of block "
          "\"B\" lies in the plane (point [-4, 0, 0], normal [1, 0, 0.001]), a plane within 4.2e-06 m of all "
          "corners of a face is needed; the nearest face is 0.001 m off, its plane has point [-4, 1, 0], "
          "normal "
          "[-1, 0, 0]"));
}

TEST(SceneChecks, MissingMaterialsAreSaidToBeMissing) {
  EXPECT_THAT(
      all_faults("[analysis]\nend_time = 1\ntime_step = 1\n[[block]]\nname = \"A\"\nmaterial = \"m\"\n"
                 "sphere = { radius = 1 }\n"),
      ElementsAre("s.toml:6:12: error: unknown material (\"m\"), there is no [[material]]"));
}

TEST(SceneChecks, FaultyValuesAreNotComplainedAboutAgain) {
  EXPECT_THAT(all_faults(sample_with(18, "name = 5\n")),
              ElementsAre(StartsWith("s.toml:7:10: error: joint names no block (\"B*\")"),
                          StartsWith("s.toml:18:8: error: name has the wrong type (5)"),
                          StartsWith("s.toml:29:9: error: unknown block (\"B\")")));
  EXPECT_THAT(all_faults(sample_with(20, "box = { min = [0, 0, 0], max = [4, 1] }")),
              ElementsAre(StartsWith("s.toml:20:32: error: max has the wrong length")));
  EXPECT_THAT(all_faults(sample_with(2, "end_time = -1")), ElementsAre(StartsWith("s.toml:2:12: error:")));
}

TEST(SceneChecks, EntriesThatAreNoTablesDoNotShiftOthers) {
  // The first block is invalid; the second one keeps its place.
  EXPECT_THAT(all_faults(sample_with(19, ""), {"block.A=1", "joint=[]"}),
              ElementsAre(StartsWith("s.toml:17:1: error: missing key (material), block \"B\" has none"),
                          "--set block.A=1: error: block has the wrong type (1), a table is needed"));
}

TEST(SceneChecks, FixedBlockNeedsNoMaterial) {
  EXPECT_THAT(all_faults(sample_with(15, "fixed = true")), IsEmpty());
}

}  // namespace
}  // namespace ashlar::test::scene_checks_test
