#include "apps/scene/expand/moving_loads.hpp"

#include <gmock/gmock.h>

#include <map>

#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::moving_loads_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Two stones of 1 m side by side on a slab; what a test adds starts at line 10.
const std::string road = R"(analysis = { end_time = 1, time_step = 1e-3 }
contact = { friction_angle = 30 }
material = [{ name = "rock", density = 2700, young_modulus = 1e9, poisson_ratio = 0.2 }]
block = [
  { name = "ground", fixed = true, box = { min = [-9, -9, -1], max = [9, 9, 0] } },
  { name = "west", material = "rock", box = { min = [0, 0, 0], max = [1, 1, 1] } },
  { name = "east", material = "rock", box = { min = [1, 0, 0], max = [2, 1, 0.5] } },
]
)";

struct Outcome {
  std::optional<LoadedScene> loaded;
  std::vector<std::string> faults;
};

Outcome load(const std::string& more) {
  Diagnostics diagnostics;
  Outcome outcome{load_scene_text(road + more, "s.toml", {}, diagnostics), {}};
  outcome.faults = printed(diagnostics);
  return outcome;
}

TEST(MovingLoads, ActOnTheTopsOfTheBlocksTheyPass) {
  const Outcome outcome =
      load("[[load]]\nforce = [0, 0, -8]\npath = [[0, 0.25, 0.5, 7], [2, 1.75, 0.5, 7]]\nspacing = 0.5\n");
  ASSERT_THAT(outcome.faults, IsEmpty());
  const std::vector<SceneBlock>& blocks = outcome.loaded->scene.block;
  ASSERT_EQ(blocks[1].load.size(), 2U);
  ASSERT_EQ(blocks[2].load.size(), 2U);
  EXPECT_TRUE(std::get<Vector3>(blocks[1].load[0].where).isApprox(Vector3(0.25, 0.5, 1)));
  EXPECT_TRUE(std::get<Vector3>(blocks[1].load[1].where).isApprox(Vector3(0.75, 0.5, 1)));
  EXPECT_TRUE(std::get<Vector3>(blocks[2].load[0].where).isApprox(Vector3(1.25, 0.5, 0.5)));
  EXPECT_TRUE(std::get<Vector3>(blocks[2].load[1].where).isApprox(Vector3(1.75, 0.5, 0.5)));
  EXPECT_EQ(blocks[2].load[0].vector, Vector3(0, 0, -8));
  const std::vector<SceneLoad::Factor>& share = blocks[2].load[0].history;
  ASSERT_EQ(share.size(), 3U);
  EXPECT_DOUBLE_EQ(share[0].time, 2.0 / 3.0);
  EXPECT_EQ(share[0].factor, 0.0);
  EXPECT_DOUBLE_EQ(share[1].time, 4.0 / 3.0);
  EXPECT_EQ(share[1].factor, 1.0);
  EXPECT_EQ(share[2].time, 2.0);
  const nlohmann::json json = to_json(outcome.loaded->scene);
  EXPECT_EQ(json.at("load").at(0).at("path").size(), 2U);
  EXPECT_FALSE(json.at("block").at(1).contains("load")) << "the scene as it was written";
}

/// At any time all shares together are the force, and their moment about the start is that of its place on a straight
/// path over one level.
TEST(MovingLoads, SharesHaveTheResultantAndTheMomentOfTheForce) {
  const std::vector<SceneMovingLoad::Stop> path = {{0.0, {0, 0, 0}}, {1.0, {1, 0, 0}}, {4.0, {2, 0, 0}}};
  const std::vector<PathPoint> points = divided_path(path, 0.3);
  ASSERT_EQ(points.size(), 9U);
  for (const auto& [time, x] :
       std::map<double, double>{{0.1, 0.1}, {0.625, 0.625}, {2.5, 1.5}, {3.9, 1.9 + 2.0 / 30}}) {
    double sum = 0.0, moment = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      double share = 0.0;
      if (k > 0 && time >= points[k - 1].time && time <= points[k].time)
        share = (time - points[k - 1].time) / (points[k].time - points[k - 1].time);
      else if (k + 1 < points.size() && time >= points[k].time && time < points[k + 1].time)
        share = (points[k + 1].time - time) / (points[k + 1].time - points[k].time);
      sum += share;
      moment += share * points[k].place.x();
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);
    EXPECT_NEAR(moment, x, 1e-14) << time;
  }
}

TEST(MovingLoads, PointsOverTheGroundAndBesideAllBlocksHaveNone) {
  const Outcome outcome =
      load("[[load]]\nforce = [0, 0, -8]\npath = [[0, -1, 0.5, 7], [2, 12, 0.5, 7]]\nspacing = 1\n");
  ASSERT_THAT(outcome.faults, IsEmpty());
  // x = 0 and 1 are on edges of the stones, 2 is on that of the eastern one.
  std::size_t loads = 0;
  for (const SceneBlock& block : outcome.loaded->scene.block) loads += block.load.size();
  EXPECT_EQ(loads, 3U);
  EXPECT_THAT(outcome.loaded->scene.block[0].load, IsEmpty());
}

TEST(MovingLoads, FaultsHaveTheirPlace) {
  const std::string start = "[[load]]\nforce = [0, 0, -8]\n";
  EXPECT_THAT(
      load(start + "path = [[0, 20, 0, 0], [1, 21, 0, 0]]\n").faults,
      ElementsAre("s.toml:11:8: error: path leads over no block, one that crosses the blocks along the force "
                  "is needed"));
  EXPECT_THAT(load(start + "path = [[0, 0, 0, 0]]\n").faults,
              ElementsAre("s.toml:11:8: error: path has too few places (1), at least 2 are needed"));
  EXPECT_THAT(
      load(start + "path = [[0, 0, 0, 0], [1, 1, 0, 0]]\nspacing = 1e-5\n").faults,
      ElementsAre("s.toml:12:11: error: path has too many points (1 m every 1e-05 m), at most 10000 are "
                  "allowed"));
  EXPECT_THAT(
      load(start + "path = [[0, 0, 0, 0], [1, 1, 0, 0]]\nblocks = [\"none\"]\n").faults,
      ElementsAre(
          "s.toml:12:10: error: load names no block (\"none\"), the name of a [[block]] or a glob that "
          "matches one is needed"));
  EXPECT_THAT(
      load("[[load]]\nforce = [0, 0, 0]\npath = [[0, 0, 0, 0], [1, 1, 0, 0]]\n").faults,
      ElementsAre("s.toml:10:9: error: force has no direction ([0, 0, 0]), a vector other than zero is "
                  "needed"));
}

}  // namespace
}  // namespace ashlar::test::moving_loads_test
