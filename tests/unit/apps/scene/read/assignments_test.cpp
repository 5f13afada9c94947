#include "apps/scene/read/assignments.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "apps/scene/check/scene_checks.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::assignments_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

std::string with(const std::string& assignments) {
  return sample() + assignments;  // from line 32 on
}

TEST(Assignments, TheLastOneThatMatchesCounts) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(with("[[assign]]\nblocks = [\"*\"]\norder = 3\nvelocity = [1, 0, 0]\n"
                                       "[[assign]]\nblocks = [\"B\", \"none?\", \"A\"]\norder = 2\n"
                                       "[[assign]]\nblocks = [\"[A]\"]\n"
                                       "[[assign.load]]\npoint = [1, 1, 2]\nforce = [0, 0, 1]\n"),
                                  "s.toml", {"assign.1.blocks=[\"B\"]"}, diagnostics);
  EXPECT_THAT(printed(diagnostics), IsEmpty());
  EXPECT_EQ(scene.block[0].order, 3);
  EXPECT_EQ(scene.block[1].order, 2);
  EXPECT_EQ(scene.block[0].velocity, Vector3(1, 0, 0));
  EXPECT_EQ(scene.block[1].velocity, Vector3(1, 0, 0));
  EXPECT_THAT(scene.block[0].load, SizeIs(1));
  EXPECT_THAT(scene.block[1].load, SizeIs(1)) << "its own";
  EXPECT_EQ(to_string(scene.places.value("block.0.order")), "s.toml:34:9");
  EXPECT_EQ(to_string(scene.places.value("block.1.order")), "s.toml:38:9");
  EXPECT_EQ(to_string(scene.places.value("block.0.load.0.point")), "s.toml:42:9");
  EXPECT_EQ(to_string(scene.places.value("block.1.load.0.plane")), "s.toml:24:9");
}

TEST(Assignments, GiveMaterials) {
  Diagnostics diagnostics;
  std::string text = sample_with(15, "") + "[[assign]]\nblocks = [\"A\"]\nmaterial = \"rock\"\n";
  Scene scene = parse_scene(text, "s.toml", {}, diagnostics);
  check_references(scene, diagnostics);
  EXPECT_THAT(printed(diagnostics), IsEmpty());
  EXPECT_EQ(scene.block[0].material, "rock");
  scene = parse_scene(text, "s.toml", {"assign.0.material=rok"}, diagnostics);
  check_references(scene, diagnostics);
  EXPECT_THAT(printed(diagnostics),
              ElementsAre("--set assign.0.material=rok: error: unknown material (\"rok\"), did "
                          "you mean \"rock\"? the name of a [[material]] is needed"));
}

TEST(Assignments, RefuseWhatNamesNoBlock) {
  EXPECT_THAT(
      reading_faults(with("[[assign]]\nblocks = [\"rock*\"]\norder = 2\n")),
      ElementsAre("s.toml:33:10: error: assign names no block (\"rock*\"), the name of a [[block]] or a glob "
                  "that matches one is needed"));
  EXPECT_THAT(reading_faults(with("[[assign]]\norder = 2\n")),
              ElementsAre(StartsWith("s.toml:32:1: error: missing key (blocks)")));
}

TEST(Assignments, AreBounded) {
  std::string blocks =
      "[[block]]\nname = \"many\"\nmaterial = \"rock\"\nbox = { min = [9, 9, 9], max = [10, 10, 10] }\n"
      "array = { count = [15000], step = [[2, 0, 0]] }\n";
  std::string history = "[[0, 0]";
  for (int k = 1; k < 2000; ++k) history += fmt::format(", [{}, 1]", k);
  history += "]";
  EXPECT_THAT(
      reading_faults(with(blocks +
                          "[[assign]]\nblocks = [\"many.*\"]\n[[assign.load]]\npoint = [9, 9, 9]\n"
                          "force = [0, 0, 1]\nhistory = " +
                          history + "\n")),
      ElementsAre(StartsWith("s.toml:37:1: error: assignments are too many for their blocks (1 entries")));
  std::string entries;
  for (int k = 0; k < 1000; ++k) entries += "[[assign]]\nblocks = [\"*\"]\norder = 2\n";
  EXPECT_THAT(reading_faults(with(blocks + entries)),
              ElementsAre(::testing::HasSubstr("assignments are too many for their blocks (1000 entries")));
  EXPECT_THAT(reading_faults(with(
                  blocks + "[[block.load]]\npoint = [9, 9, 9]\nforce = [0, 0, 1]\nhistory = " + history)),
              ElementsAre(StartsWith("s.toml:36:9: error: copies of block \"many\" take too much memory")));
}

TEST(Assignments, RefuseMotionOfFixedBlocks) {
  EXPECT_THAT(
      reading_faults(with("[[assign]]\nblocks = [\"*\"]\nfixed = true\n")),
      ElementsAre("s.toml:32:1: error: motion of a fixed block (B), a block with fixed = true takes no fix, "
                  "load or velocity"));
}

}  // namespace
}  // namespace ashlar::test::assignments_test
