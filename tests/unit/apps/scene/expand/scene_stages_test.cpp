#include "apps/scene/expand/scene_stages.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "apps/scene/assemble/scene_loading.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::test::scene_stages_test {
namespace {

using ::testing::ElementsAre;

const std::string blocks = R"(analysis = { end_time = 4, time_step = 1 }
contact = { friction_angle = 30 }
material = [{ name = "m", density = 2000, young_modulus = 1e9, poisson_ratio = 0.2 }]
[[block]]
name = "floor"
fixed = true
box = { min = [-9, -9, -1], max = [9, 9, 0] }
[[block]]
name = "a"
material = "m"
box = { min = [0, 0, 0], max = [1, 1, 1] }
load = [{ point = [0, 0, 1], force = [8, 0, 0], history = [[0, 0], [8, 1]] }]
[[block]]
name = "late"
material = "m"
box = { min = [3, 0, 0], max = [4, 1, 1] }
load = [{ point = [3, 0, 1], force = [8, 0, 0], history = [[0, 1], [8, 0]] }]
)";

Scene loaded(const std::string& stages) {
  const TemporaryFolder folder;
  write_text(folder / "s.toml", blocks + stages);
  Diagnostics diagnostics;
  std::optional<LoadedScene> scene = load_scene(folder / "s.toml", {}, diagnostics);
  EXPECT_TRUE(scene) << (scene ? "" : to_string(diagnostics.sorted().front()));
  return scene ? std::move(scene->scene) : Scene();
}

/// x of each load of a block, and the rows of its history.
std::vector<std::pair<double, std::size_t>> loads_of(const Scene& scene, std::size_t block) {
  std::vector<std::pair<double, std::size_t>> loads;
  for (const SceneLoad& load : scene.block[block].load)
    loads.emplace_back(load.vector.x(), load.history.size());
  return loads;
}

TEST(SceneStages, HistoriesStayWhatTheyWereAtTheEndOfTheirStage) {
  const Scene scene = loaded(R"([[stage]]
name = "one"
[[stage]]
name = "two"
analysis = { end_time = 2, time_step = 0.5 }
add = ["late"]
load = [{ blocks = ["a"], point = [0, 0, 1], force = [4, 0, 0], history = [[0, 0], [4, 1]] }]
[[stage]]
name = "three"
remove = ["a"]
)");
  using Loads = std::vector<std::vector<std::pair<double, std::size_t>>>;
  Loads of_a, of_late;
  std::vector<std::vector<bool>> absent;
  std::vector<std::string> places;
  for_each_stage(ExpandedScene(scene), [&](const Scene& stage) {
    of_a.push_back(loads_of(stage, 1));
    of_late.push_back(loads_of(stage, 2));
    absent.push_back(stage.absent);
    const Place place = stage.places.value("analysis.time_step");
    places.push_back(std::to_string(place.line) + ":" + std::to_string(place.column));
  });
  // a: 8 t/8 until t = 4 of the first stage, 4 at its end; the second adds 4 t/4 until t = 2.
  EXPECT_EQ(of_a, (Loads{{{8.0, 2}}, {{4.0, 0}, {4.0, 2}}, {{4.0, 0}, {2.0, 0}}}));
  // late comes in the second stage: 8 (1 - t/8) until t = 2.
  EXPECT_EQ(of_late, (Loads{{{8.0, 2}}, {{8.0, 2}}, {{6.0, 0}}}));
  EXPECT_THAT(absent, ElementsAre(ElementsAre(false, false, true), ElementsAre(false, false, false),
                                  ElementsAre(false, true, false)));
  // The key of a stage is where the stage has it, and that of the next one where [analysis] has it.
  EXPECT_THAT(places, ElementsAre("1:40", "22:40", "1:40"));
}

TEST(SceneStages, OneAloneIsTheSameAsInTurn) {
  const Scene scene = loaded(R"([[stage]]
name = "one"
load = [{ blocks = ["a"], point = [0, 0, 1], force = [1, 0, 0] }]
remove = ["late"]
[[stage]]
name = "two"
joint = [{ blocks = ["a", "floor"], friction_angle = 20 }]
[[stage]]
name = "three"
material = [{ name = "m", density = 1000, young_modulus = 1e9, poisson_ratio = 0.2 }]
)");
  std::size_t k = 0;
  for_each_stage(ExpandedScene(scene), [&](const Scene& stage) {
    const Scene alone = scene_of_stage(ExpandedScene(scene), k++);
    EXPECT_EQ(alone.absent, stage.absent);
    EXPECT_EQ(alone.joint.size(), k < 2 ? 0U : 1U);
    EXPECT_EQ(stage.joint.size(), alone.joint.size());
    EXPECT_EQ(stage.material[0].density, k < 3 ? 2000.0 : 1000.0);
    EXPECT_EQ(alone.material[0].density, stage.material[0].density);
  });
  EXPECT_EQ(k, 3U);
}

TEST(SceneStages, AreCheckedInATimeThatGoesWithTheirNumber) {
  std::string stages;
  for (int k = 0; k < 2000; ++k)
    stages += "[[stage]]\nname = \"s" + std::to_string(k) +
              "\"\nanalysis.end_time = " + std::to_string(k + 1) + "\n";
  // If each were built from all before it, these would be 2e6 stages, a minute.
  const Scene scene = loaded(stages);
  ASSERT_EQ(scene.stage.size(), 2000U);
  EXPECT_EQ(scene_of_stage(ExpandedScene(scene), 1999).analysis.end_time, 2000.0);
}

}  // namespace
}  // namespace ashlar::test::scene_stages_test
