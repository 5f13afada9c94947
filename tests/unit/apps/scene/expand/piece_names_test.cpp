#include "apps/scene/expand/piece_names.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "apps/scene/model/cut_rock.hpp"
#include "apps/scene/model/joint_table.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"
#include "unit/apps/scene/expand/sample_rock.hpp"

namespace ashlar::test::piece_names_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Outcome {
  std::optional<LoadedScene> loaded;
  std::string text;
};

Outcome load(const std::string& more) {
  Diagnostics diagnostics;
  Outcome outcome{load_scene_text(rock_scene + more, "s.toml", {}, diagnostics), ""};
  for (const Diagnostic& fault : diagnostics.sorted()) outcome.text += to_string(fault) + "\n";
  return outcome;
}

std::vector<std::string> names(const LoadedScene& loaded) {
  std::vector<std::string> result;
  for (const SceneBlock& block : loaded.scene.block) result.push_back(block.name);
  return result;
}

// Two rounds of a tunnel, and a plane through both.
const std::string rounds =
    "[[cut]]\nname = \"round1\"\nblocks = [\"rock\"]\nsolid = { box = { min = [0.5, -1, 0.5], max = [1, 1, "
    "1] } }\n"
    "[[cut]]\nname = \"round2\"\nblocks = [\"rock\"]\nsolid = { box = { min = [0.5, 1, 0.5], max = [1, 3, 1] "
    "} }\n"
    "[[cut]]\nname = \"level\"\nblocks = [\"rock.round2.inside.*\"]\ndip = 0\ndip_direction = 0\npoint = [0, "
    "0, "
    "0.75]\n";

// The part that a cut makes follows the rest, so that the second round comes first.
TEST(PieceNames, NamesKeepTheCuts) {
  const Outcome outcome = load(rounds + "[[measure]]\nname = \"m\"\nblock = \"rock.inside.2\"\n");
  ASSERT_TRUE(outcome.loaded) << outcome.text;
  const Scene& scene = outcome.loaded->scene;
  EXPECT_THAT(names(*outcome.loaded), ElementsAre("ground", "rock.1", "rock.round2.inside.1",
                                                  "rock.round2.inside.2", "rock.round1.inside.1"));
  EXPECT_THAT(scene.rock->other_names[0], ElementsAre());
  EXPECT_THAT(scene.rock->other_names[1], ElementsAre("rock.round1.1", "rock.round2.1"));
  // The rounds meet in a face that the first one made.
  EXPECT_THAT(scene.rock->other_names[2], ElementsAre("rock.inside.1", "rock.round1.2", "rock.level.1"));
  EXPECT_THAT(scene.rock->other_names[3], ElementsAre("rock.inside.2", "rock.round1.3", "rock.level.2"));
  EXPECT_THAT(scene.rock->other_names[4], ElementsAre("rock.inside.3"));
  EXPECT_EQ(scene.measure[0].block, "rock.round2.inside.2");
}

TEST(PieceNames, EveryNameOfAPieceIsUnderstood) {
  const Outcome outcome =
      load(rounds +
           "[[assign]]\nblocks = [\"rock.level.*\"]\norder = 2\n"
           "[[joint]]\nblocks = [\"rock.inside.1\", \"rock.level.2\"]\nfriction_angle = 11\n"
           "[[stage]]\nname = \"a\"\nremove = [\"rock.round1.inside.*\"]\n"
           "[[stage]]\nname = \"b\"\nremove = [\"rock.inside.1\", \"rock.inside.2\"]\n");
  ASSERT_TRUE(outcome.loaded) << outcome.text;
  const Scene& scene = outcome.loaded->scene;
  EXPECT_EQ(scene.block[2].order, 2);
  EXPECT_EQ(scene.block[3].order, 2);
  EXPECT_EQ(scene.block[4].order, 1);
  const JointTable table(scene);
  EXPECT_EQ(table.law_between(2, 3).friction_angle, 11.0);
  EXPECT_EQ(table.law_between(1, 3).friction_angle, 30.0);
  EXPECT_EQ(stage_of(*outcome.loaded, 0).scene.absent, (std::vector<bool>{false, false, false, false, true}));
  EXPECT_EQ(stage_of(*outcome.loaded, 1).scene.absent, (std::vector<bool>{false, false, true, true, true}));
}

TEST(PieceNames, ASolidInASolidKeepsBoth) {
  const Outcome outcome = load(
      "[[cut]]\nname = \"tunnel\"\nblocks = [\"rock\"]\nsolid = { box = { min = [0.5, -1, 0.5], max = [1.5, "
      "3, 1.5] } "
      "}\n"
      "[[cut]]\nname = \"heading\"\nblocks = [\"rock\"]\nsolid = { box = { min = [0, -1, 1], max = [2, 3, 3] "
      "} }\n");
  ASSERT_TRUE(outcome.loaded) << outcome.text;
  const Scene& scene = outcome.loaded->scene;
  std::map<std::string, std::vector<std::string>> others;
  for (std::size_t k = 0; k < scene.block.size(); ++k)
    others[scene.block[k].name] = scene.rock->other_names[k];
  // The heading has the upper half of the tunnel and the rock above it.
  ASSERT_TRUE(others.contains("rock.tunnel.inside.1")) << ::testing::PrintToString(names(*outcome.loaded));
  int in_both = 0;
  for (const auto& [name, more] : others)
    if (name.starts_with("rock.heading.inside.") &&
        std::any_of(more.begin(), more.end(),
                    [](const std::string& other) { return other.starts_with("rock.tunnel.inside."); }))
      ++in_both;
  EXPECT_EQ(in_both, 1);
}

// A joint through the whole cube, one that ends inside it, and one beside it.
TEST(MeasuredJoints, ATableOfMeasuredJoints) {
  const TemporaryFolder folder;
  write_text(folder / "joints.csv",
             "id,dip_direction,dip,x,y,z,radius\n1,0,0,1,1,0.5,\n2,90,90,1.5,1,1,0.25\n3,90,90,3,1,1,0.5\n"
             "4,90,90,0.5,1,1,9\n");
  write_text(folder / "s.toml",
             rock_scene + "[[cut]]\nname = \"seen\"\nblocks = [\"rock\"]\nfile = \"joints.csv\"\n");
  Diagnostics diagnostics;
  const auto loaded = load_scene(folder / "s.toml", {}, diagnostics);
  ASSERT_TRUE(loaded);
  // Level at 0.5; upright at x = 1.5 through the upper part alone, whose middle is within 0.25 m of the disc.
  std::vector<double> volumes;
  for (const Polyhedron& solid : loaded->solids) volumes.push_back(solid.volume());
  std::sort(volumes.begin(), volumes.end());
  EXPECT_THAT(volumes, ElementsAre(0.5, 1.5, 1.5, 1.5, 3.0, 16.0));
  EXPECT_EQ(loaded->scene.rock->extended[0], 1);
  ASSERT_EQ(diagnostics.sorted().size(), 1U);
  EXPECT_THAT(to_string(diagnostics.sorted()[0]),
              HasSubstr("s.toml:20:8: warning: cut \"seen\" divides 1 piece by joints that end inside, which "
                        "are extended"));
  EXPECT_EQ(to_json(loaded->scene).at("cut").at(0).at("file"), "joints.csv");
}

}  // namespace
}  // namespace ashlar::test::piece_names_test
