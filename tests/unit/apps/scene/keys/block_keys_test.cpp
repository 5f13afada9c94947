#include "apps/scene/keys/block_keys.hpp"

#include <gmock/gmock.h>

#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::block_keys_test {
namespace {

using ::testing::ElementsAre;
using ::testing::StartsWith;

class BlockKeysFault : public ::testing::TestWithParam<FaultCase> {};

TEST_P(BlockKeysFault, IsReportedOnceAtItsPlace) {
  const FaultCase& fault = GetParam();
  EXPECT_THAT(reading_faults(sample_with(fault.line, fault.replacement)),
              ElementsAre(StartsWith(fault.expected)));
}

INSTANTIATE_TEST_SUITE_P(
    Block, BlockKeysFault,
    ::testing::Values(
        FaultCase{14, "", "s.toml:13:1: error: missing key (name), block needs it"},
        FaultCase{15, "material = \"rock\"\norder = -1",
                  "s.toml:16:9: error: order is out of range (-1), a whole number from 0 to 12 or \"auto\" "
                  "is needed"},
        FaultCase{15, "material = \"rock\"\norder = 99", "s.toml:16:9: error: order is out of range (99)"},
        FaultCase{15, "material = \"rock\"\norder = 3.0",
                  "s.toml:16:9: error: order has the wrong type (3.0)"},
        FaultCase{15, "material = \"rock\"\nvelocity = [1, 2, 3, 4]",
                  "s.toml:16:12: error: velocity has the wrong length"},
        FaultCase{15, "material = \"rock\"\ntranslate = [1, 2, inf]",
                  "s.toml:16:20: error: translate is not finite (inf)"},
        FaultCase{15, "material = \"rock\"\nscale = 2", "s.toml:16:1: error: unknown key in block (scale)"},
        FaultCase{15, "fixed = true\nvelocity = [1, 0, 0]",
                  "s.toml:16:12: error: velocity of a fixed block ([1, 0, 0])"}));

INSTANTIATE_TEST_SUITE_P(
    Shape, BlockKeysFault,
    ::testing::Values(
        FaultCase{16, "",
                  "s.toml:13:1: error: block has no shape (none given), exactly one of box, mesh, hull, "
                  "sphere is needed"},
        FaultCase{
            16, "box = { min = [0, 0, 0], max = [1, 1, 1.7e308] }",
            "s.toml:16:32: error: max has a coordinate that is too large (1.7e+308 m), -1e150 to 1e150"},
        FaultCase{16, "box = { min = [0, -2e150, 0], max = [1, 1, 1] }",
                  "s.toml:16:15: error: min has a coord"},
        FaultCase{16, "hull = { points = [[0,0,0],[1,0,0],[0,1,0],[0,0,2e150]] }",
                  "s.toml:16:44: error: points has a coordinate that is too large (2e+150 m)"},
        FaultCase{16, "sphere = { radius = 2e150 }", "s.toml:16:21: error: radius is out of range (2.e+150)"},
        FaultCase{16, "sphere = { radius = 1, center = [2e150, 0, 0] }",
                  "s.toml:16:33: error: center has a coord"},
        FaultCase{16, "box = { min = [0,0,0], max = [1,1,1] }\ntranslate = [0, 0, -2e150]",
                  "s.toml:17:13: error: translate has a coordinate that is too large (-2e+150 m)"},
        FaultCase{
            16,
            "box = { min = [0,0,0], max = [1,1,1] }\nrotate = { axis = [0, 0, 1e200], angle = 30, about = "
            "[2e150, 0, 0] }",
            "s.toml:17:54: error: about has a coordinate that is too large (2e+150 m)"},
        FaultCase{16, "box = { min = [0,0,0], max = [1,1,1] }\nsphere = { radius = 1 }",
                  "s.toml:13:1: error: block has 2 shapes (box, sphere), exactly one of"},
        FaultCase{16, "box = [1, 2, 3]",
                  "s.toml:16:7: error: box has the wrong type ([1, 2, 3]), a table is needed"},
        FaultCase{16, "box = { min = [0, 0, 0] }",
                  "s.toml:16:1: error: missing key (max), block.box needs it"},
        FaultCase{16, "box = { min = [0, 1, 0], max = [1, 1, 1] }",
                  "s.toml:16:15: error: min is not below max in y (1 and 1)"},
        FaultCase{16, "box = { min = [0, 0, 0], max = [1, 1] }",
                  "s.toml:16:32: error: max has the wrong length (2 entries)"},
        FaultCase{16, "mesh = { file = \"a\\u0000.off\" }",
                  "s.toml:16:17: error: file cannot be used as a name (\"a"},
        FaultCase{16, "mesh = { scale = 1.0 }",
                  "s.toml:16:1: error: missing key (file), block.mesh needs it"},
        FaultCase{16, "mesh = { file = \"a.off\", scale = -1 }",
                  "s.toml:16:34: error: scale is out of range (-1), a number > 0"},
        FaultCase{16, "hull = { points = [[0,0,0],[1,0,0],[0,1,0]] }",
                  "s.toml:16:19: error: points has too few entries (3), at least 4 of [x, y, z] are needed"},
        FaultCase{16, "hull = { points = [[0,0,0],[1,0,0],[0,1,0],[0,0]] }",
                  "s.toml:16:44: error: points has the wrong length (2 entries)"},
        FaultCase{16, "sphere = { radius = 0 }", "s.toml:16:21: error: radius is out of range (0)"},
        FaultCase{16, "sphere = { radius = 1, subdivisions = 8 }",
                  "s.toml:16:39: error: subdivisions is out of range (8)"},
        FaultCase{16, "box = { min = [0,0,0], max = [1,1,1] }\nrotate = { axis = [0, 0, 0], angle = 30 }",
                  "s.toml:17:19: error: axis has no direction ([0, 0, 0])"},
        FaultCase{16, "box = { min = [0,0,0], max = [1,1,1] }\nrotate = { axis = [0, 0, 1] }",
                  "s.toml:17:1: error: missing key (angle), block.rotate needs it"}));

INSTANTIATE_TEST_SUITE_P(
    Fix, BlockKeysFault,
    ::testing::Values(
        FaultCase{22, "plane = { point = [2e150, 0, 0], normal = [-1, 0, 0] }",
                  "s.toml:22:19: error: point has a coordinate that is too large (2e+150 m)"},
        FaultCase{22, "point = [2e150, 0, 0]",
                  "s.toml:22:9: error: point has a coordinate that is too large"},
        FaultCase{22, "", "s.toml:21:1: error: block.fix has no place (none given), exactly one of"},
        FaultCase{22, "plane = { point = [0, 0, 0], normal = [-1, 0, 0] }\npoint = [0, 0, 0]",
                  "s.toml:21:1: error: block.fix has 2 places"},
        FaultCase{22, "plane = { point = [0, 0, 0], normal = [0, 0, 0] }",
                  "s.toml:22:39: error: normal has no direction"},
        FaultCase{22, "plane = { point = [0, 0, 0] }",
                  "s.toml:22:1: error: missing key (normal), block.fix.plane needs it"},
        FaultCase{22, "point = [0, 0, 0]\ncomponents = []", "s.toml:23:14: error: components is empty"},
        FaultCase{22, "point = [0, 0, 0]\ncomponents = [\"x\", \"w\"]",
                  "s.toml:23:20: error: unknown components (\"w\")"},
        FaultCase{22, "point = [0, 0, 0]\nvelocity = [0, 0, 0]",
                  "s.toml:23:1: error: unknown key in block.fix (velocity), velocity belongs to block"},
        FaultCase{22, "point = [0, 0, 0]\ndisplacement_history = [[0, 0, 0, 0], [0, 1, 0, 0]]",
                  "s.toml:23:39: error: time in displacement_history does not increase (0 after 0)"},
        FaultCase{
            22,
            "point = [0, 0, 0]\ncomponents = [\"x\"]\ndisplacement_history = [[0, 0, 0, 0], [1, 2, 3, 0]]",
            "s.toml:24:24: error: displacement_history moves a component that is not held (uy = 3 at t = 1)"},
        // 0.5 halfway between the two times
        FaultCase{
            22, "point = [0, 0, 0]\ndisplacement_history = [[-1, 0, 0, 0], [1, 0, 1, 0]]",
            "s.toml:23:24: error: displacement_history is not zero at t = 0, where the block is placed (uy "
            "= 0.5), 0 is needed"},
        FaultCase{
            22, "point = [0, 0, 0]\ndisplacement_history = [[1, 0, 0, 3]]",
            "s.toml:23:24: error: displacement_history is not zero at t = 0, where the block is placed (uz "
            "= 3), 0 is needed"},
        FaultCase{22, "point = [0, 0, 0]\ndisplacement_history = [[0, 0, 0]]",
                  "s.toml:23:25: error: displacement_history has the wrong length (3 entries), [t, ux, uy, "
                  "uz] is"}));

INSTANTIATE_TEST_SUITE_P(
    Load, BlockKeysFault,
    ::testing::Values(FaultCase{25, "", "s.toml:23:1: error: block.load has no size (none given)"},
                      FaultCase{25, "traction = [0, 0, 1]\nforce = [0, 0, 1]",
                                "s.toml:23:1: error: block.load has 2 sizes"},
                      FaultCase{24, "point = [4, 0, 0]", "s.toml:25:1: error: traction at a point"},
                      FaultCase{25, "force = [0, 0]",
                                "s.toml:25:9: error: force has the wrong length (2 entries)"},
                      FaultCase{25, "force = [0, 0, 1]\nhistory = [[0, 1], [2, 1], [1, 0]]",
                                "s.toml:26:28: error: time in history does not increase (1 after 2)"},
                      FaultCase{25, "force = [0, 0, 1]\nhistory = []",
                                "s.toml:26:11: error: history has too few entries (0)"}));

TEST(BlockKeys, FixedBlockTakesNoSupportAndNoLoad) {
  EXPECT_THAT(reading_faults(sample_with(19, "fixed = true")),
              ElementsAre(StartsWith("s.toml:21:1: error: fix on a fixed block (B)"),
                          StartsWith("s.toml:23:1: error: load on a fixed block (B)")));
}

}  // namespace
}  // namespace ashlar::test::block_keys_test
