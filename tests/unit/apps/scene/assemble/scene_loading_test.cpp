#include "apps/scene/assemble/scene_loading.hpp"

#include <gmock/gmock.h>

#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::scene_loading_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

TEST(SceneLoading, FallingBlockIsTheSceneOfThePaper) {
  Diagnostics diagnostics;
  const auto loaded = load_scene(ASHLAR_DATA_DIR "/scenes/falling_block.toml", {}, diagnostics);
  ASSERT_THAT(printed(diagnostics), IsEmpty());
  const Scene& scene = loaded->scene;
  // 1350 steps of 1 ms, and A's bottom 1 m above B's top, flush with its end and centred.
  EXPECT_EQ(scene.analysis.end_time / scene.analysis.time_step, 1350.0);
  EXPECT_EQ(scene.analysis.initial_state, SceneAnalysis::InitialState::equilibrium);
  EXPECT_EQ(loaded->solids.at(0).volume(), 1.5 * 1.5 * 1.5);
  EXPECT_EQ(loaded->solids.at(1).volume(), 24.0);
  const SceneBox a = std::get<SceneBox>(scene.block[0].shape), b = std::get<SceneBox>(scene.block[1].shape);
  EXPECT_EQ(a.min.z() - b.max.z(), 1.0);
  EXPECT_EQ(a.max.x(), b.max.x());
  EXPECT_EQ(a.min.y() + a.max.y(), b.min.y() + b.max.y());
  EXPECT_EQ(scene.block[0].order, 1);
  EXPECT_EQ(scene.block[1].order, 3);
  EXPECT_EQ(find_material(scene, scene.block[1].material)->young_modulus, 5e8);
}

TEST(SceneLoading, ListsFaultsOfEveryKindInFileOrder) {
  const TemporaryFolder folder;
  const std::string file = (folder / "bad.toml").string();
  write_text(file,
             "[analysis]\n"
             "end_time = 1\n"
             "time_step = -0.1\n"
             "sovler = \"cg\"\n"
             "[[joint]]\n"
             "blocks = [\"A\", \"nobody\"]\n"
             "[[material]]\n"
             "name = \"rock\"\n"
             "density = -3600\n"
             "young_modulus = 1e9\n"
             "poisson_ratio = 0.5\n"
             "[[block]]\n"
             "name = \"A\"\n"
             "material = \"rock\"\n"
             "order = -1\n"
             "mesh = { file = \"open.off\" }\n"
             "[[block]]\n"
             "name = \"A\"\n"
             "material = \"rock\"\n"
             "order = 99\n"
             "box = { min = [0, 0, 0], max = [1, 1, 1] }\n"
             "velocity = [nan, 0, 0]\n"
             "[[block.fix]]\n"
             "plane = { point = [0, 0, 7], normal = [0, 0, 1] }\n");
  Diagnostics diagnostics;
  EXPECT_FALSE(load_scene(file, {"block.7.order=1"}, diagnostics).has_value());
  EXPECT_THAT(
      printed(diagnostics),
      ElementsAre(StartsWith(file + ":3:13: error: time_step is out of range (-0.1)"),
                  StartsWith(file + ":4:1: error: unknown key in analysis (sovler), did you mean solver?"),
                  StartsWith(file + ":6:10: error: joint names no block (\"nobody\")"),
                  StartsWith(file + ":9:11: error: density is out of range (-3600)"),
                  StartsWith(file + ":11:17: error: poisson_ratio is out of range (0.5)"),
                  StartsWith(file + ":15:9: error: order is out of range (-1)"),
                  StartsWith(file + ":16:17: error: mesh file cannot be used ("),
                  StartsWith(file + ":18:8: error: block named twice (\"A\""),
                  StartsWith(file + ":20:9: error: order is out of range (99)"),
                  StartsWith(file + ":22:13: error: velocity is not finite (nan)"),
                  StartsWith(file + ":24:9: error: no face of block \"A\" lies in the plane"),
                  StartsWith("--set block.7.order=1: error: no such entry of block (7)")));
  EXPECT_EQ(folder.entry_count(), 1u);
}

}  // namespace
}  // namespace ashlar::test::scene_loading_test
