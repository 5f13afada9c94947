#include "apps/scene/expand/region_blocks.hpp"

#include <gmock/gmock.h>

#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "apps/scene/model/joint_table.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::region_blocks_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Four cubes of 1 m in a row along x, row.1 with its centroid at x = 0.5, on a slab; what a test adds starts at
/// line 14.
const std::string row_scene = R"(analysis = { end_time = 0.01, time_step = 1e-3 }
contact = { friction_angle = 30 }
material = [{ name = "rock", density = 2700, young_modulus = 1e9, poisson_ratio = 0.2 },
            { name = "clay", density = 2000, young_modulus = 1e8, poisson_ratio = 0.3 }]
[[block]]
name = "ground"
fixed = true
box = { min = [-1, -1, -1], max = [5, 2, 0] }
[[block]]
name = "row"
material = "rock"
box = { min = [0, 0, 0], max = [1, 1, 1] }
array = { count = [4], step = [[1, 0, 0]] }
)";

struct Outcome {
  std::optional<LoadedScene> loaded;
  std::vector<std::string> faults;
};

Outcome load(const std::string& more) {
  Diagnostics diagnostics;
  Outcome outcome{load_scene_text(row_scene + more, "s.toml", {}, diagnostics), {}};
  outcome.faults = printed(diagnostics);
  return outcome;
}

/// Names of the blocks of a material.
std::vector<std::string> of_material(const Outcome& outcome, const std::string& material) {
  std::vector<std::string> names;
  if (outcome.loaded)
    for (const SceneBlock& block : outcome.loaded->scene.block)
      if (block.material == material) names.push_back(block.name);
  return names;
}

std::vector<std::string> clay_inside(const std::string& region, const std::string& names = "") {
  const Outcome outcome = load("[[assign]]\ninside = { " + region + " }\nmaterial = \"clay\"\n" + names);
  EXPECT_THAT(outcome.faults, IsEmpty());
  return of_material(outcome, "clay");
}

TEST(RegionBlocks, CentroidsOnTheBoundaryAreInside) {
  EXPECT_THAT(clay_inside("box = { min = [1, 0, 0.5], max = [2.5, 1, 1] }"), ElementsAre("row.2", "row.3"));
  // Below and left of x + z = 2, where the centroid of row.2 lies.
  EXPECT_THAT(clay_inside("halfspace = { point = [2, 7, 0], normal = [3, 0, 3] }", "blocks = [\"row.*\"]\n"),
              ElementsAre("row.1", "row.2"));
  EXPECT_THAT(clay_inside("sphere = { center = [3.5, 0.5, 0.5], radius = 0.1 }"), ElementsAre("row.4"));
  EXPECT_THAT(clay_inside("hull = { points = [[0, 0, 0], [4, 0, 0], [0, 1, 0], [0, 0, 1.5]] }"),
              ElementsAre("row.1"));
}

TEST(RegionBlocks, ComeAfterAssignmentsByName) {
  const Outcome outcome = load(
      "[[assign]]\ninside = { box = { min = [0, 0, 0], max = [2, 1, 1] } }\nmaterial = \"rock\"\norder = 2\n"
      "[[assign]]\nblocks = [\"row.*\"]\nmaterial = \"clay\"\n");
  EXPECT_THAT(outcome.faults, IsEmpty());
  EXPECT_THAT(of_material(outcome, "rock"), ElementsAre("row.1", "row.2"));
  EXPECT_EQ(outcome.loaded->scene.block[1].order, 2);
}

TEST(RegionBlocks, JointsAreThoseBetweenBlocksInside) {
  const Outcome outcome = load(
      "[[joint]]\ninside = { box = { min = [0, 0, 0], max = [2, 1, 1] } }\nfriction_angle = 10\n"
      "[[joint]]\nblocks = [\"row.*\", \"ground\"]\nfriction_angle = 20\n");
  ASSERT_THAT(outcome.faults, IsEmpty());
  const JointTable table(outcome.loaded->scene);
  EXPECT_EQ(table.law_between(1, 2).friction_angle, 10.0);
  EXPECT_EQ(table.law_between(2, 3).friction_angle, 30.0);
  EXPECT_EQ(table.law_between(0, 1).friction_angle, 20.0);
  const nlohmann::json json = to_json(outcome.loaded->scene);
  EXPECT_EQ(json.at("joint").at(0).at("inside").at("box").at("max"), (nlohmann::json{2.0, 1.0, 1.0}));
}

TEST(RegionBlocks, AMeasureIsOfTheOneBlockInside) {
  const Outcome outcome =
      load("[[measure]]\nname = \"m\"\ninside = { box = { min = [2, 0, 0], max = [3, 1, 1] } }\n");
  ASSERT_THAT(outcome.faults, IsEmpty());
  EXPECT_EQ(outcome.loaded->scene.measure[0].block, "row.3");
}

TEST(RegionBlocks, ListsOfStagesChooseAmongTheBlocksThere) {
  const std::string left = "inside = { halfspace = { point = [2, 0, 0], normal = [1, 0, 0] } }";
  const Outcome outcome = load(
      "[[block]]\nname = \"prop\"\nmaterial = \"rock\"\nbox = { min = [0, 0, 1], max = [1, 1, 2] }\n"
      "[[stage]]\nname = \"1\"\nremove = [\"row.1\"]\n"
      "[[stage]]\nname = \"2\"\nremove = { blocks = [\"row.*\", \"prop\"], " +
      left +
      " }\n"
      "[[stage]]\nname = \"3\"\nadd = [\"prop\", \"row.1\"]\n"
      "[[stage.fix]]\nblocks = [\"row.*\"]\n" +
      left + "\nplane = { point = [0, 0, 0], normal = [0, 0, 1] }\n");
  ASSERT_THAT(outcome.faults, IsEmpty());
  const Scene& scene = outcome.loaded->scene;
  // The prop is held back until stage 3, row.1 is gone before stage 2.
  EXPECT_THAT(scene.stage[1].remove, ElementsAre("row.2"));
  EXPECT_THAT(scene.stage[2].fix[0].blocks, ElementsAre("row.1", "row.2"));
  EXPECT_EQ(scene_of_stage(ExpandedScene(scene), 1).absent,
            (std::vector<bool>{false, true, true, false, false, true}));
  EXPECT_EQ(to_json(scene).at("stage").at(1).at("remove"), (nlohmann::ordered_json{"row.2"}));
}

TEST(RegionBlocks, CutsAreOfThePiecesInside) {
  const Outcome outcome = load(
      "[[cut]]\nname = \"x\"\nblocks = [\"row.1\"]\ndip = 90\ndip_direction = 90\npoint = [0.5, 0, 0]\n"
      "[[cut]]\nname = \"z\"\nblocks = [\"row.1\"]\ndip = 0\ndip_direction = 0\npoint = [0, 0, 0.5]\n"
      "inside = { box = { min = [0, 0, 0], max = [0.3, 1, 1] } }\n"
      "[[assign]]\nmaterial = \"clay\"\ninside = { box = { min = [0, 0, 0.5], max = [0.3, 1, 1] } }\n");
  ASSERT_THAT(outcome.faults, IsEmpty());
  EXPECT_EQ(outcome.loaded->solids.size(), 7U);
  ASSERT_EQ(of_material(outcome, "clay").size(), 1U);
  for (std::size_t k = 0; k < outcome.loaded->solids.size(); ++k) {
    if (outcome.loaded->scene.block[k].material == "clay") {
      EXPECT_EQ(outcome.loaded->solids[k].volume(), 0.25);
    }
  }
}

TEST(RegionBlocks, FaultsHaveTheirPlace) {
  EXPECT_THAT(
      load("[[assign]]\ninside = { box = { min = [9, 9, 9], max = [10, 10, 10] } }\norder = 2\n").faults,
      ElementsAre("s.toml:15:1: error: no block of these names has its centroid inside (inside), a region "
                  "with one is needed; `ashlar blocks --json` lists centroids"));
  EXPECT_THAT(
      load("[[measure]]\nname = \"m\"\ninside = { box = { min = [0, 0, 0], max = [2, 1, 1] } }\n").faults,
      ElementsAre(
          "s.toml:16:1: error: inside holds the centroids of 2 blocks (\"row.1\", \"row.2\"), that of "
          "one is needed"));
  EXPECT_THAT(
      load("[[assign]]\ninside = { }\norder = 2\n").faults,
      ElementsAre(
          "s.toml:15:1: error: assign.inside has no shape (none given), exactly one of box, mesh, hull, "
          "sphere, halfspace is needed"));
  EXPECT_THAT(
      load("[[assign]]\ninside = { halfspace = { point = [0, 0, 0], normal = [0, 0, 0] } }\norder = 2\n")
          .faults,
      ElementsAre(
          "s.toml:15:54: error: normal has no direction ([0, 0, 0]), a vector other than zero is needed"));
  EXPECT_THAT(
      load("[[stage]]\nname = \"a\"\nremove = { inside = { mesh = { file = \"none.off\" } } }\n").faults,
      ::testing::Contains(::testing::StartsWith("s.toml:16:39: error: mesh file cannot be used")));
  EXPECT_THAT(
      load("[[stage]]\nname = \"a\"\nremove = { }\n").faults,
      ElementsAre("s.toml:16:10: error: remove has the wrong type (a table), an array of texts or { blocks, "
                  "inside } is needed"));
}

}  // namespace
}  // namespace ashlar::test::region_blocks_test
