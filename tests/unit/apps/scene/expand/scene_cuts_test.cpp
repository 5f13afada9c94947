#include "apps/scene/expand/scene_cuts.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "apps/scene/assemble/build_simulation.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "apps/scene/model/cut_rock.hpp"
#include "apps/scene/model/joint_table.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"
#include "unit/apps/scene/expand/sample_rock.hpp"

namespace ashlar::test::scene_cuts_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string along_x = "[[cut]]\nname = \"x\"\nblocks = [\"rock\"]\ndip = 90\ndip_direction = 90\n";
const std::string along_z = "[[cut]]\nname = \"z\"\nblocks = [\"rock\"]\ndip = 0\ndip_direction = 0\n";

struct Outcome {
  std::optional<LoadedScene> loaded;
  std::string text;
};

Outcome load(const std::string& more) {
  const TemporaryFolder folder;
  write_text(folder / "s.toml", rock_scene + more);
  Diagnostics diagnostics;
  Outcome outcome;
  outcome.loaded = load_scene(folder / "s.toml", {}, diagnostics);
  for (const Diagnostic& fault : diagnostics.sorted()) {
    Diagnostic short_of_folder = fault;
    short_of_folder.place.origin = "s.toml";
    outcome.text += to_string(short_of_folder) + "\n";
  }
  return outcome;
}

std::vector<std::string> names(const LoadedScene& loaded) {
  std::vector<std::string> result;
  for (const SceneBlock& block : loaded.scene.block) result.push_back(block.name);
  return result;
}

TEST(SceneCuts, PiecesStandInTheBlocksPlace) {
  const Outcome outcome =
      load(along_x + "point = [1, 0, 0]\n" + along_z + "point = [0, 0, 0.5]\nspacing = 1\n");
  ASSERT_TRUE(outcome.loaded) << outcome.text;
  EXPECT_THAT(names(*outcome.loaded),
              ElementsAre("ground", "rock.1", "rock.2", "rock.3", "rock.4", "rock.5", "rock.6"));
  std::vector<double> volumes;
  for (const Polyhedron& solid : outcome.loaded->solids) volumes.push_back(solid.volume());
  EXPECT_THAT(volumes, ElementsAre(16, 1, 2, 1, 1, 2, 1));
  EXPECT_EQ(outcome.loaded->scene.block[3].velocity, Vector3::UnitX());
  const auto json = to_json(outcome.loaded->scene);
  EXPECT_EQ(json.at("block").size(), 2U) << "the scene as it was written";
  EXPECT_EQ(json.at("cut").size(), 2U);
}

TEST(SceneCuts, WhatMissesLeavesTheName) {
  const Outcome outcome = load(along_x + "point = [2, 0, 0]\n");
  ASSERT_TRUE(outcome.loaded) << outcome.text;
  EXPECT_THAT(names(*outcome.loaded), ElementsAre("ground", "rock"));
}

TEST(SceneCuts, PiecesInsideASolidHaveTheirOwnNames) {
  const Outcome outcome = load(
      "[[cut]]\nname = \"tunnel\"\nblocks = [\"rock\"]\nsolid = { box = { min = [0.5, -1, 0.5], max = [1, 3, "
      "1] } "
      "}\n[[cut]]\nname = \"in\"\nblocks = [\"rock.inside.*\"]\ndip = 90\ndip_direction = 0\npoint = [0, 1, "
      "0]\n");
  ASSERT_TRUE(outcome.loaded) << outcome.text;
  EXPECT_THAT(names(*outcome.loaded), ElementsAre("ground", "rock.1", "rock.inside.1", "rock.inside.2"));
  EXPECT_EQ(outcome.loaded->solids[1].volume(), 7.5);
  EXPECT_EQ(outcome.loaded->solids[2].volume(), 0.25);
}

TEST(SceneCuts, SupportsLoadsAndMeasuresGoToTheirPieces) {
  const Outcome outcome = load(
      "[[block.fix]]\nplane = { point = [0, 0, 0], normal = [1, 0, 0] }\n"
      "[[block.load]]\nplane = { point = [0, 0, 2], normal = [0, 0, 1] }\nforce = [0, 0, -8]\n"
      "[[measure]]\nname = \"far\"\nblock = \"rock\"\npoint = [2, 1, 1]\n" +
      along_x + "point = [0.5, 0, 0]\n");
  ASSERT_TRUE(outcome.loaded) << outcome.text;
  const std::vector<SceneBlock>& blocks = outcome.loaded->scene.block;
  EXPECT_EQ(blocks[1].fix.size(), 1U);
  EXPECT_EQ(blocks[2].fix.size(), 0U);
  ASSERT_EQ(blocks[1].load.size(), 1U);
  ASSERT_EQ(blocks[2].load.size(), 1U);
  EXPECT_EQ(blocks[1].load[0].vector.z(), -2.0) << "a quarter of the area";
  EXPECT_EQ(blocks[2].load[0].vector.z(), -6.0);
  EXPECT_EQ(outcome.loaded->scene.measure[0].block, "rock.2");
}

TEST(SceneCuts, TurningBlocksPiecesMoveWithIt) {
  const Outcome outcome = load("angular_velocity = [0, 0, 1]\n" + along_x + "point = [1, 0, 0]\n");
  ASSERT_TRUE(outcome.loaded) << outcome.text;
  // Centroids are half a metre beside the axis.
  EXPECT_EQ(outcome.loaded->scene.block[1].velocity, Vector3(1, -0.5, 0));
  EXPECT_EQ(outcome.loaded->scene.block[2].velocity, Vector3(1, 0.5, 0));
}

TEST(SceneCuts, AssignmentsMeanPiecesWhereTheyMeanNoBlock) {
  const std::string cuts = along_x + "point = [1, 0, 0]\n" + along_z + "point = [0, 0, 1]\n";
  const std::string low =
      "[[assign]]\nblocks = [\"rock.[13]\"]\norder = 2\n[[assign.fix]]\n"
      "plane = { point = [0, 0, 0], normal = [0, 0, 1] }\n";
  const std::string all =
      "[[assign]]\nblocks = [\"rock*\"]\nvelocity = [0, 2, 0]\n[[assign.load]]\n"
      "plane = { point = [0, 0, 2], normal = [0, 0, 1] }\nforce = [0, 0, -8]\n";
  const Outcome outcome = load(cuts + low + all);
  ASSERT_TRUE(outcome.loaded) << outcome.text;
  const Scene& scene = outcome.loaded->scene;
  std::vector<int> orders;
  std::vector<std::size_t> supports, loads;
  for (const SceneBlock& block : scene.block) {
    orders.push_back(block.order);
    supports.push_back(block.fix.size());
    loads.push_back(block.load.size());
  }
  EXPECT_THAT(orders, ElementsAre(1, 2, 1, 2, 1));
  EXPECT_THAT(supports, ElementsAre(0, 1, 0, 1, 0));
  EXPECT_THAT(loads, ElementsAre(0, 0, 1, 0, 1)) << "a block's load is divided, and not given again";
  EXPECT_EQ(scene.block[2].velocity, Vector3(0, 2, 0));
  EXPECT_EQ(scene.places.value("block.3.order").line, 31);
  EXPECT_EQ(scene.places.value("block.3.velocity").line, 36);
  EXPECT_EQ(scene.places.value("block.3.box").line, 15);
  EXPECT_EQ(scene.places.value("block.4.load.0.force").line, 39);
  const auto json = to_json(scene);
  ASSERT_EQ(json.at("assign").size(), 1U) << "what a block got is in the block";
  EXPECT_EQ(json.at("assign")[0].at("blocks"), nlohmann::ordered_json({"rock.1", "rock.3"}));
  EXPECT_EQ(json.at("assign")[0].at("order"), 2);
  EXPECT_THAT(load(cuts + "[[assign]]\nblocks = [\"rock.5\"]\norder = 2\n").text,
              HasSubstr("s.toml:30:10: error: assign names no block (\"rock.5\"), did you mean \"rock.1\"?"));
}

TEST(SceneCuts, JointOfACutIsOfItsFaces) {
  const Outcome outcome = load(along_x + "point = [1, 0, 0]\n" + along_z + "point = [0, 0, 1]\n" +
                               "[[joint]]\ncut = \"x\"\nfriction_angle = 10\n"
                               "[[joint]]\ncut = \"z\"\nfriction_angle = 20\ncohesion = 5\n");
  ASSERT_TRUE(outcome.loaded) << outcome.text;
  // rock.1 low left, rock.2 high left, rock.3 low right, rock.4 high right.
  const JointTable table(outcome.loaded->scene);
  EXPECT_EQ(table.law_between(1, 3).friction_angle, 10.0);
  EXPECT_EQ(table.law_between(2, 4).friction_angle, 10.0);
  EXPECT_EQ(table.law_between(1, 2).friction_angle, 20.0);
  EXPECT_EQ(table.law_between(1, 2).cohesion, 5.0);
  EXPECT_EQ(table.law_between(0, 1).friction_angle, 30.0) << "the ground was not cut";
  // Across the middle edge both planes have a face of each: the later joint counts.
  EXPECT_EQ(table.law_between(1, 4).friction_angle, 20.0);
}

TEST(SceneCuts, GluedCutTiesItsFaces) {
  const Outcome outcome =
      load(along_x + "point = [1, 0, 0]\nglued = true\n" + along_z + "point = [0, 0, 1]\n");
  ASSERT_TRUE(outcome.loaded) << outcome.text;
  Diagnostics diagnostics;
  const auto built = build_simulation(*outcome.loaded, 1, diagnostics);
  ASSERT_TRUE(built);
  EXPECT_TRUE(diagnostics.good());
  std::vector<std::pair<int, int>> ties;
  for (const auto& tie : built->simulation.system().ties()) ties.emplace_back(tie.a, tie.b);
  EXPECT_THAT(ties, ElementsAre(std::pair(1, 3), std::pair(2, 4)));
  EXPECT_FALSE(to_json(outcome.loaded->scene).contains("joint"));
}

TEST(SceneCuts, SmallPiecesAreGluedAndCounted) {
  const Outcome outcome = load(along_x + "point = [0.25, 0, 0]\nmin_volume = 1.5\n");
  ASSERT_TRUE(outcome.loaded) << outcome.text;
  EXPECT_THAT(names(*outcome.loaded), ElementsAre("ground", "rock"));
  EXPECT_EQ(outcome.loaded->scene.rock->glued[0], 1);
}

TEST(SceneCuts, PersistenceZeroAndSmallDiscsCutNothing) {
  for (const std::string key : {"persistence = 0\n", "radius = 0.5\npoint = [1, -2, 0]\n"}) {
    const Outcome outcome = load(along_x + (key.starts_with("p") ? "point = [1, 0, 0]\n" : "") + key);
    ASSERT_TRUE(outcome.loaded) << outcome.text;
    EXPECT_THAT(names(*outcome.loaded), ElementsAre("ground", "rock")) << key;
  }
}

TEST(SceneCuts, RefusesTooManyBlocksBeforeItMakesThem) {
  const Outcome outcome = load(along_x + "spacing = 1e-12\n");
  EXPECT_FALSE(outcome.loaded);
  EXPECT_EQ(outcome.text,
            "s.toml:22:11: error: cut \"x\" makes too many blocks (about 2e+12 in the scene), at most "
            "most_blocks = "
            "100000 are allowed\n");
}

// A slab of 1e-7 x 2 x 2 m of a cube of 8 m^3: a ten millionth of the mean of two pieces.
TEST(SceneCuts, WarnsOfSlivers) {
  const Outcome outcome = load(along_x + "point = [1e-7, 0, 0]\n");
  ASSERT_TRUE(outcome.loaded) << outcome.text;
  EXPECT_THAT(outcome.text,
              HasSubstr("s.toml:17:1: warning: cuts leave 1 sliver among 2 pieces of block \"rock\" (the "
                        "least, \"rock.1\", has 4e-07 m^3, a piece has 4 m^3 in the mean)"));
  EXPECT_THAT(outcome.text, HasSubstr("min_volume = 4e-05 glues it\n"));
  const Outcome glued = load(along_x + "point = [1e-7, 0, 0]\nmin_volume = 4e-5\n");
  ASSERT_TRUE(glued.loaded) << glued.text;
  EXPECT_EQ(glued.text, "");
  EXPECT_EQ(load(along_x + "point = [1e-5, 0, 0]\n").text, "");
}

TEST(SceneCuts, NamesThePlanesOfWhatIsLostInRounding) {
  // 1e-15 m is four units in the last place at 1 m: no solid is that thin there.
  const Outcome outcome = load(along_x + "point = [1, 0, 0]\nspacing = 1e-15\nnumber = 1\n");
  EXPECT_FALSE(outcome.loaded);
  EXPECT_THAT(outcome.text,
              StartsWith("s.toml:17:1: error: cut makes a piece that is lost in rounding (4e-15 m^3, "
                         "\"rock.2\" between plane -1 of cut \"x\", plane 0 of cut \"x\"; "));
  EXPECT_THAT(outcome.text, HasSubstr("min_volume"));
}

TEST(SceneCuts, PlanesThatCutNothingAreCountedToo) {
  // 2 m of rock at 2e-9 m: 1e9 planes from 0 to 2, of which one in 1e5 cuts.
  const std::string rare = along_z + "persistence = 1e-5\npoint = [0, 0, 1]\nmost_blocks = 20000\n";
  EXPECT_THAT(
      load(rare + "spacing = 4e-9\n").text,
      HasSubstr("s.toml:25:11: error: cut \"z\" has too many planes (about 5e+08), at most 100000 are "
                "allowed, or most_blocks if that is more, up to 10000000; a larger spacing is needed"));
  // Drawing ends at the first plane beyond the limit, so that this seed takes little time.
  EXPECT_THAT(load(rare + "spacing = { mean = 1e-6, deviation = 1e-7 }\n").text,
              HasSubstr("cut \"z\" has too many planes (at least 100001), at most 100000 are allowed"));
  const Outcome fewer = load(along_z + "persistence = 0\npoint = [0, 0, 1]\nspacing = 1e-3\n");
  EXPECT_TRUE(fewer.loaded) << fewer.text;
}

TEST(SceneCuts, DrawnPlanesOfManyBlocksAreDrawnOnce) {
  // 9e6 spacings lie below each of 400 blocks: 4e9 draws, were it block by block.
  std::string scene = "array = { count = [20, 20], step = [[3, 0, 0], [0, 3, 0]] }\n";
  scene +=
      "[[cut]]\nname = \"c\"\nblocks = [\"rock*\"]\ndip = 0\ndip_direction = 0\npoint = [0, 0, -900001]\n";
  scene += "spacing = { mean = 0.1, deviation = 0.01 }\npersistence = 0\n";
  const Outcome outcome = load(scene);
  EXPECT_TRUE(outcome.loaded) << outcome.text;
}

TEST(SceneCuts, CellsAreMadeInTurnedNeedlesAndSlabs) {
  // One point in 2e7 of the needle's bounding box would be inside.
  for (const char* size : {"1e4, 1, 1", "1e5, 1e5, 0.1"}) {
    const Outcome outcome = load(
        fmt::format("[[block]]\nname = \"n\"\nmaterial = \"rock\"\nbox = {{ min = [0, 0, 0], max = [{}] }}\n"
                    "rotate = {{ axis = [1, -2, 3], angle = 50 }}\ntranslate = [0, 0, 1e6]\n"
                    "[[cut]]\nname = \"c\"\nblocks = [\"n\"]\nvoronoi = {{ count = 5 }}\n",
                    size));
    ASSERT_TRUE(outcome.loaded) << outcome.text;
    EXPECT_EQ(outcome.loaded->scene.block.size(), 7U) << size;  // ground, rock and five cells
  }
}

TEST(SceneCuts, FaultsHaveTheirPlaces) {
  struct Case {
    std::string scene;
    std::string fault;
  };
  const std::string head = "[[cut]]\nname = \"c\"\nblocks = [\"rock\"]\n";
  for (const auto& [scene, fault] : std::vector<Case>{
           {head, "s.toml:17:1: error: missing key (dip), cut needs it"},
           {"[[cut]]\nname = \"c\"\nblocks = [\"rokc\"]\ndip = 0\ndip_direction = 0\n",
            "s.toml:19:10: error: cut names no block (\"rokc\"), did you mean \"rock\"? the name of a "
            "[[block]]"},
           {head + "dip = 91\ndip_direction = 0\n",
            "s.toml:20:7: error: dip is out of range (91), a number of degrees from 0 to 90 is needed"},
           {head + "dip = 1\ndip_direction = 0\nspacing = 0\n",
            "s.toml:22:11: error: spacing is out of range (0), a number > 0 and <= 1e150 is needed"},
           {head + "dip = 1\ndip_direction = 0\nnumber = 2\n",
            "s.toml:22:10: error: number of planes without their spacing (2), a spacing is needed"},
           {head + "dip = 1\ndip_direction = 0\nspacing = { mean = 1, deviation = 0.6, distribution = "
                   "\"uniform\" }\n",
            "s.toml:22:35: error: deviation lets spacings be zero or less (0.6), less than mean / sqrt(3) = "
            "0.57735 is needed"},
           {head + "dip = 1\ndip_direction = 0\nspacing = { mean = 1, deviation = 101, distribution = "
                   "\"lognormal\" }\n",
            "s.toml:22:35: error: deviation is out of range (101), at most 100 times the mean (100) is "
            "needed"},
           {head +
                "dip = 1\ndip_direction = 0\npoint = [0, 0, 1e6]\nspacing = { mean = 1e-3, deviation = 1e-3, "
                "distribution = \"exponential\" }\nmost_blocks = 100000000\n",
            "too far from the blocks for this spacing (1e+06 m), less than 1e+07 spacings are allowed"},
           {head + "voronoi = { count = 3 }\ndip = 3\n",
            "s.toml:21:1: error: dip beside voronoi (both given), only one of both is allowed"},
           {head + "voronoi = { count = 3000000 }\n",
            "s.toml:20:11: error: cut \"c\" makes too many blocks (about 3e+06 in the scene), at most "
            "most_blocks"},
           {"[[joint]]\ncut = \"y\"\n", "s.toml:18:7: error: unknown cut (\"y\"), there is no [[cut]]"},
           {along_x + along_x, "s.toml:23:8: error: cut named twice (\"x\", first at "},
           {along_x + "[[joint]]\ncut = \"y\"\n",
            "s.toml:23:7: error: unknown cut (\"y\"), the name of a [[cut]] is needed"},
           {head + "dip = 1\ndip_direction = 0\npersistance = 1\n",
            "s.toml:22:1: error: unknown key in cut (persistance), did you mean persistence?"},
           {along_x +
                "point = [1, 0, 0]\n[[cut]]\nname = \"v\"\nblocks = [\"rock\"]\nvoronoi = { count = 3 }\n",
            "s.toml:23:1: error: cut \"v\" cannot be made: cells around points need a block that is convex"}})
    EXPECT_THAT(load(scene).text, HasSubstr(fault)) << scene;
}

}  // namespace
}  // namespace ashlar::test::scene_cuts_test
