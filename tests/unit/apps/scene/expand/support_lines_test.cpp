#include "apps/scene/expand/support_lines.hpp"

#include <gmock/gmock.h>

#include <string>

#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::test::support_lines_test {
namespace {

using ::testing::HasSubstr;

const std::string blocks = R"(analysis = { type = "static" }
contact = { friction_angle = 30 }
material = [{ name = "m", density = 2000, young_modulus = 1e9, poisson_ratio = 0.2 }]
[[block]]
name = "floor"
fixed = true
box = { min = [-2, -2, -1], max = [3, 3, 0] }
[[block]]
name = "a"
material = "m"
order = 2
box = { min = [0, 0, 0], max = [1, 1, 1] }
[[block]]
name = "b"
material = "m"
box = { min = [0, 0, 1.5], max = [1, 1, 2] }
)";

struct Found {
  std::optional<LoadedScene> scene;
  std::string first_fault;
};

Found loaded(const std::string& text) {
  const TemporaryFolder folder;
  write_text(folder / "s.toml", blocks + text);
  Diagnostics diagnostics;
  Found found;
  found.scene = load_scene(folder / "s.toml", {}, diagnostics);
  if (!diagnostics.sorted().empty()) found.first_fault = to_string(diagnostics.sorted().front());
  return found;
}

std::vector<SupportLine> lines_of(const LoadedScene& scene, std::size_t stage = 0) {
  std::vector<const Polyhedron*> solids;
  for (const Polyhedron& solid : scene.solids) solids.push_back(&solid);
  return support_lines(scene_of_stage(ExpandedScene(scene.scene), stage), solids);
}

const std::string steel = "area = 1e-3\nbond_stiffness = 1e9\n";

TEST(SupportLines, ABoltHasAPieceInEachBlock) {
  const Found found =
      loaded("[[bolt]]\nname = \"b1\"\nfrom = [0.5, 0.5, 2.5]\nto = [0.5, 0.5, -0.5]\n" + steel);
  ASSERT_TRUE(found.scene) << found.first_fault;
  const std::vector<SupportLine> lines = lines_of(*found.scene);
  ASSERT_EQ(lines.size(), 1U);
  ASSERT_EQ(lines[0].spans.size(), 3U);
  EXPECT_EQ(lines[0].spans[0].block, 2);
  EXPECT_DOUBLE_EQ(lines[0].spans[0].start, 0.5);
  EXPECT_DOUBLE_EQ(lines[0].spans[0].end, 1.0);
  EXPECT_EQ(lines[0].spans[1].block, 1);
  EXPECT_EQ(lines[0].spans[1].order, 2);
  EXPECT_DOUBLE_EQ(lines[0].spans[2].start, 2.5);
  EXPECT_DOUBLE_EQ(lines[0].spans[2].end, 3.0);
}

TEST(SupportLines, APatternHasHeadsWhereBarsGoIntoABlock) {
  const Found found = loaded(
      "[[bolt]]\nname = \"p\"\npattern = { plane = { point = [0.25, 0.25, 2], normal = [0, 0, 1] }, spacing "
      "= [0.5, "
      "0.25], length = 2.5 }\n" +
      steel + "[[measure]]\nname = \"m\"\nbolt = \"p.8\"\n");
  ASSERT_TRUE(found.scene) << found.first_fault;
  const std::vector<SupportLine> lines = lines_of(*found.scene);
  // x at 0.25, 0.75; y at 0.25, 0.5, 0.75, and at the edges 0 and 1 as far as the line is inside.
  ASSERT_GE(lines.size(), 6U);
  for (const SupportLine& line : lines) {
    EXPECT_EQ(line.spans.front().block, 2);
    EXPECT_EQ(line.spans.back().block, 0);
    EXPECT_NEAR(line.to.z(), -0.5, 1e-15);
  }
}

/// A pillar beside the face goes through its plane, and another lies lower: bars from there would go into rock at once too.
TEST(SupportLines, HeadsOfAPatternAreOnFacesOnly) {
  const Found found = loaded(
      "[[block]]\nname = \"pillar\"\nmaterial = \"m\"\nbox = { min = [1, 0, 0], max = [3, 1, 4] }\n"
      "[[bolt]]\nname = \"p\"\npattern = { plane = { point = [0.25, 0.25, 2], normal = [0, 0, 1] }, spacing "
      "= [0.6, 0.6], length = 0.4 }\n" +
      steel);
  ASSERT_TRUE(found.scene) << found.first_fault;
  std::vector<std::array<double, 2>> heads;
  for (const SupportLine& line : lines_of(*found.scene)) heads.push_back({line.from.x(), line.from.y()});
  // The face is the unit square; 1.45 is in the pillar.
  EXPECT_THAT(heads,
              testing::ElementsAre(testing::ElementsAre(0.25, 0.25), testing::ElementsAre(0.85, 0.25),
                                   testing::ElementsAre(0.25, 0.85), testing::ElementsAre(0.85, 0.85)));
}

TEST(SupportLines, APropStandsBetweenTheBlocksBehindItsEnds) {
  const Found found =
      loaded("[[prop]]\nname = \"p\"\nstiffness = 1e7\nfrom = [0.5, 0.5, 1]\nto = [0.5, 0.5, 1.5]\n");
  ASSERT_TRUE(found.scene) << found.first_fault;
  const std::vector<SupportLine> lines = lines_of(*found.scene);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].spans[0].block, 1);
  EXPECT_EQ(lines[0].spans[1].block, 2);
  EXPECT_DOUBLE_EQ(lines[0].law.axial_stiffness, 5e6);
}

TEST(SupportLines, ATieIsHeldByTheBlocksAtItsEnds) {
  const std::string tie = "[[bolt]]\nname = \"t\"\narea = 1e-3\nanchored = \"ends\"\n";
  const auto blocks_of = [&](const std::string& ends) {
    const Found found = loaded(tie + ends);
    EXPECT_TRUE(found.scene) << found.first_fault;
    const SupportLine line = found.scene ? lines_of(*found.scene).at(0) : SupportLine{};
    return line.spans.empty() ? std::array{-1, -1} : std::array{line.spans[0].block, line.spans[1].block};
  };
  // Between faces, with plates on outer faces, and inside.
  EXPECT_EQ(blocks_of("from = [0.5, 0.5, 1]\nto = [0.5, 0.5, 1.5]\n"), (std::array{1, 2}));
  EXPECT_EQ(blocks_of("from = [0.5, 0.5, 0]\nto = [0.5, 0.5, 2]\n"), (std::array{1, 2}));
  EXPECT_EQ(blocks_of("from = [0.5, 0.5, -0.5]\nto = [0.5, 0.5, 1.7]\n"), (std::array{0, 2}));
}

TEST(SupportLines, StagesInstallAndRemove) {
  const Found found =
      loaded("[[bolt]]\nname = \"b1\"\nfrom = [0.5, 0.5, 1.8]\nto = [0.5, 0.5, -0.5]\n" + steel +
             R"([[stage]]
name = "one"
[[stage]]
name = "two"
remove_support = ["b*"]
[[stage.bolt]]
name = "b2"
from = [0.2, 0.5, 1.8]
to = [0.2, 0.5, -0.5]
area = 1e-3
anchored = "ends"
)");
  ASSERT_TRUE(found.scene) << found.first_fault;
  const std::vector<SupportLine> first = lines_of(*found.scene, 0), second = lines_of(*found.scene, 1);
  ASSERT_EQ(first.size(), 2U);
  ASSERT_EQ(second.size(), 2U);
  EXPECT_TRUE(first[0].installed);
  EXPECT_FALSE(first[1].installed);
  EXPECT_FALSE(second[0].installed);
  EXPECT_TRUE(second[1].installed);
}

TEST(SupportLines, FaultsNameTheEndAndThePlace) {
  const auto fault = [](const std::string& text) { return loaded(text).first_fault; };
  EXPECT_THAT(fault("[[bolt]]\nname = \"b1\"\nfrom = [5, 5, 5]\nto = [5, 5, 9]\n" + steel),
              HasSubstr("bolt \"b1\" meets no block"));
  EXPECT_THAT(fault("[[bolt]]\nname = \"b1\"\nfrom = [0.5, 0.5, 2.5]\nto = [0.5, 0.5, 0.5]\narea = "
                    "1e-3\nanchored = \"ends\"\n"),
              HasSubstr("the end `from` of bolt \"b1\" is at no block ([0.5, 0.5, 2.5]), a point on or in a "
                        "block is needed"));
  EXPECT_THAT(fault("[[prop]]\nname = \"p\"\nstiffness = 1e7\nfrom = [0.5, 0.5, 1]\nto = [0.5, 0.5, 1.4]\n"),
              HasSubstr("the end `to` of prop \"p\" is at no block"));
  EXPECT_THAT(fault("[[bolt]]\nname = \"b1\"\nfrom = [0, 0, 0]\nto = [0, 0, 0]\n" + steel),
              HasSubstr("both ends are the same point"));
  EXPECT_THAT(fault("[[bolt]]\nname = \"b1\"\nfrom = [0.5, 0.5, 1.8]\nto = [0.5, 0.5, -0.5]\narea = 1e-3\n"),
              HasSubstr("missing key (bond_stiffness)"));
  EXPECT_THAT(fault("[[measure]]\nname = \"m\"\nbolt = \"b1\"\n"), HasSubstr("unknown bolt (\"b1\")"));
  EXPECT_THAT(fault("[[bolt]]\nname = \"b1\"\nfrom = [0.5, 0.5, 0.8]\nto = [0.5, 0.5, 0.2]\n" + steel),
              HasSubstr("is in one block only (\"a\")"));
}

}  // namespace
}  // namespace ashlar::test::support_lines_test
