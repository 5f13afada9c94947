#include "apps/scene/assemble/scene_placement.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/assemble/scene_reader.hpp"
#include "apps/scene/expand/scene_solids.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "geometry/boxes/box.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/scene/assemble/placed_scenes.hpp"

namespace ashlar::scene_placement_test {
namespace {

using test_support::about_x;
using test_support::about_z;
using test_support::cube;
using test_support::scene_of;
using test_support::start;
using test_support::statics;

void expect_near(const Vector3& found, const Vector3& expected) {
  EXPECT_NEAR((found - expected).norm(), 0.0, 1e-12) << found.transpose() << ", not " << expected.transpose();
}

TEST(ScenePlacement, TurnsAndShiftsAndBack) {
  const ScenePlacement placement = about_z();
  EXPECT_EQ(placement.point({4, 5, 6}), Vector3(-4, 6, 9));
  EXPECT_EQ(placement.direction({4, 5, 6}), Vector3(-5, 4, 6));
  EXPECT_EQ(placement.point_back({-4, 6, 9}), Vector3(4, 5, 6));
  EXPECT_EQ(placement.direction_back({-5, 4, 6}), Vector3(4, 5, 6));
  Eigen::Matrix3d stress;
  stress << 1, 4, 6, 4, 2, 5, 6, 5, 3;
  Eigen::Matrix3d turned;
  turned << 2, -4, -5, -4, 1, 6, -5, 6, 3;
  EXPECT_EQ(placement.tensor(stress), turned);
  EXPECT_EQ(placement.tensor_back(turned), stress);
}

TEST(ScenePlacement, WithoutRotationAndShiftASceneIsUnchanged) {
  const Scene scene = scene_of(statics + cube + "rotate = { axis = [1, 2, 3], angle = 20 }\n");
  EXPECT_EQ(to_json(placed(scene, {})), to_json(scene));
}

/// Every corner of every kind of shape, with and without a rotation and a translation of its own.
TEST(ScenePlacement, Shapes) {
  const std::string turned =
      "rotate = { axis = [1, 0, 2], angle = 50, about = [1, 1, 3] }\ntranslate = [1, -2, 0.5]\n";
  const std::string text =
      statics + cube +
      "[[block]]\nname = \"B\"\nmaterial = \"rock\"\nbox = { min = [0, 0, 0], max = [1, 2, 3] }\n" + turned +
      "[[block]]\nname = \"C\"\nmaterial = \"rock\"\n"
      "hull = { points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]] }\n" +
      turned +
      "[[block]]\nname = \"D\"\nmaterial = \"rock\"\nsphere = { center = [5, 5, 5], radius = 1, subdivisions "
      "= 0 }\n"
      "array = { count = [2], step = [[3, 0, 1]] }\n"
      "[[masonry]]\nname = \"wall\"\nkind = \"wall\"\nmaterial = \"rock\"\nlength = 2\nheight = 1\nbrick = "
      "[1, 0.5, 0.5]\n"
      "origin = [8, 0, 0]\ndirection = [1, 1, 0]\n";
  for (const ScenePlacement& placement : {about_z(), about_x()}) {
    Diagnostics faults;
    const Scene scene = scene_of(text);
    const auto here = build_solids(scene, faults), there = build_solids(placed(scene, placement), faults);
    ASSERT_TRUE(faults.good());
    ASSERT_EQ(here.size(), 10U);
    for (std::size_t k = 0; k < here.size(); ++k) {
      const auto &own = here[k]->mesh().points, &turned_points = there[k]->mesh().points;
      ASSERT_EQ(own.size(), turned_points.size());
      for (std::size_t n = 0; n < own.size(); ++n) expect_near(turned_points[n], placement.point(own[n]));
    }
  }
}

TEST(ScenePlacement, SupportsLoadsAndVelocitiesOfBlocks) {
  const Scene scene = placed(scene_of(start + "analysis = { end_time = 1, time_step = 0.1 }\n" + cube + R"(
velocity = [1, 2, 3]
angular_velocity = [4, 5, 6]
[[block.fix]]
plane = { point = [0, 1, 2], normal = [1, 0, 0] }
displacement_history = [[0, 0, 0, 0], [1, 1, 2, 3]]
[[block.load]]
point = [2, 4, 6]
force = [7, 8, 9]
[[block.load]]
plane = { point = [2, 0, 0], normal = [1, 0, 0] }
traction = ["= x", "= y", 5]
[[block.load]]
plane = { point = [2, 0, 0], normal = [1, 0, 0] }
traction = [1, 2, 5]
[[assign]]
blocks = ["A"]
inside = { halfspace = { point = [9, 9, 9], normal = [0, 1, 0] } }
velocity = [1, 0, 0]
angular_velocity = [0, 1, 0]
fix = [{ point = [1, 1, 1] }]
load = [{ point = [2, 2, 2], force = [0, 1, 0] }]
)"),
                             about_z());
  const SceneBlock& block = scene.block[0];
  EXPECT_EQ(block.velocity, Vector3(-2, 1, 3));
  EXPECT_EQ(block.angular_velocity, Vector3(-5, 4, 6));
  EXPECT_EQ(std::get<ScenePlane>(block.fix[0].where).point, Vector3(0, 2, 5));
  EXPECT_EQ(std::get<ScenePlane>(block.fix[0].where).normal, Vector3(0, 1, 0));
  EXPECT_EQ(block.fix[0].history[1].value, Vector3(-2, 1, 3));
  EXPECT_EQ(std::get<Vector3>(block.load[0].where), Vector3(-3, 4, 9));
  EXPECT_EQ(block.load[0].vector, Vector3(-8, 7, 9));
  // At the place before, (2, 3, 4), the traction is (2, 3, 5).
  EXPECT_EQ(block.load[1].field.at({-2, 4, 7}), (std::vector<double>{-3, 2, 5}));
  EXPECT_EQ(block.load[2].vector, Vector3(-2, 1, 5));
  const SceneAssign& assign = scene.assign[0];
  EXPECT_EQ(std::get<SceneHalfspace>(assign.inside->space).point, Vector3(-8, 11, 12));
  EXPECT_EQ(std::get<SceneHalfspace>(assign.inside->space).normal, Vector3(-1, 0, 0));
  EXPECT_EQ(*assign.velocity, Vector3(0, 1, 0));
  EXPECT_EQ(*assign.angular_velocity, Vector3(-1, 0, 0));
  EXPECT_EQ(std::get<Vector3>(assign.fix[0].where), Vector3(0, 3, 4));
  EXPECT_EQ(assign.load[0].vector, Vector3(-1, 0, 0));
}

TEST(ScenePlacement, GravityAndDirectionsOfAnalyses) {
  Scene scene = placed(scene_of(start + R"(
analysis = { type = "thrust", gravity = [1, 2, -10], movement = { supports = ["A"], direction = [1, 0, 0] } }
)" + cube + "fixed = true\n"),
                       about_z());
  EXPECT_EQ(scene.analysis.gravity, Vector3(-2, 1, -10));
  EXPECT_EQ(*scene.analysis.movement.direction, Vector3(0, 1, 0));
  scene = placed(
      scene_of(
          start +
          "analysis = { end_time = 1, time_step = 0.1, gravity_history = [[0, 0, 0, -9], [1, 1, 2, -9]] }\n" +
          cube + R"(
[[stage]]
name = "one"
analysis = { type = "static", gravity = [1, 0, -9] }
prop = [{ name = "p", stiffness = 1, from = [1, 0, 0], to = [0, 1, 0] }]
fix = [{ blocks = ["A"], point = [1, 1, 1] }]
load = [{ blocks = ["A"], point = [1, 1, 1], force = [1, 0, 0] }]
[[stage]]
name = "two"
)"),
      about_z());
  const SceneStage &one = scene.stage[0], &two = scene.stage[1];
  EXPECT_EQ(scene.analysis.gravity, Vector3(0, 1, -9));
  EXPECT_EQ(one.analysis.gravity, Vector3(0, 1, -9));
  EXPECT_EQ(two.analysis.gravity_history[1].value, Vector3(-2, 1, -9));
  EXPECT_EQ(one.prop[0].from, Vector3(1, 3, 3));
  EXPECT_EQ(one.prop[0].to, Vector3(0, 2, 3));
  EXPECT_EQ(std::get<Vector3>(one.fix[0].fix.where), Vector3(0, 3, 4));
  EXPECT_EQ(one.load[0].load.vector, Vector3(0, 1, 0));
}

TEST(ScenePlacement, BoltsPropsMovingLoadsAndMeasures) {
  const std::string text = start + "analysis = { end_time = 1, time_step = 0.1 }\n" + cube + R"(
[[bolt]]
name = "b"
area = 1
bond_stiffness = 1
from = [1, 0, 6]
to = [1, 0, 0]
[[bolt]]
name = "c"
area = 1
bond_stiffness = 1
pattern = { plane = { point = [2, 0, 0], normal = [1, 0, 0] }, spacing = [1, 2], length = 1, direction = [-1, 0, 1] }
[[prop]]
name = "p"
stiffness = 1
from = [0, 0, 0]
to = [1, 2, 3]
[[load]]
force = [1, 0, -1]
path = [[0, 0, 0, 0], [1, 1, 2, 3]]
[[measure]]
name = "m"
block = "A"
point = [1, 2, 3]
[[measure]]
name = "n"
inside = { box = { min = [0, 0, 0], max = [2, 4, 6] } }
)";
  const Scene scene = placed(scene_of(text), about_z());
  EXPECT_EQ(scene.bolt[0].from, Vector3(1, 3, 9));
  EXPECT_EQ(scene.bolt[0].to, Vector3(1, 3, 3));
  EXPECT_EQ(scene.bolt[1].pattern->plane.point, Vector3(1, 4, 3));
  EXPECT_EQ(scene.bolt[1].pattern->plane.normal, Vector3(0, 1, 0));
  EXPECT_EQ(*scene.bolt[1].pattern->direction, Vector3(0, -1, 1));
  EXPECT_EQ(scene.prop[0].to, Vector3(-1, 3, 6));
  EXPECT_EQ(scene.load[0].force, Vector3(0, 1, -1));
  EXPECT_EQ(scene.load[0].path[1].place, Vector3(-1, 3, 6));
  EXPECT_EQ(*scene.measure[0].point, Vector3(-1, 3, 6));
  // A box on its side is a hull.
  const auto& hull = std::get<SceneHull>(std::get<SceneShape>(scene.measure[1].inside->space));
  EXPECT_EQ(hull.points.size(), 8U);
  Box box;
  for (const Vector3& point : hull.points) box.include(point);
  EXPECT_EQ(box.low, Vector3(-3, 2, 3));
  EXPECT_EQ(box.high, Vector3(1, 4, 9));
}

TEST(ScenePlacement, HeightsAreAlongTheTurnedGravity) {
  const std::string text = statics + cube + R"(
[[measure]]
name = "d"
drift = { blocks = ["A"], heights = [1, 5] }
[[water]]
level = { point = [0, 0, 4], normal = [0, 0, 1] }
unit_weight = 1
[initial_stress]
k0 = 0.5
surface = 6
[[stage]]
name = "one"
water = [{ level = { point = [0, 0, 4], normal = [1, 0, 1] }, unit_weight = 1 }]
)";
  Scene scene = placed(scene_of(text), about_z());
  EXPECT_EQ(scene.measure[0].drift->heights, (std::array<double, 2>{4.0, 8.0}));
  EXPECT_EQ(scene.initial_stress.surface, 9.0);
  // Up is against y: a place at the height h is at y = 2 - h.
  scene = placed(scene_of(text), about_x());
  EXPECT_EQ(scene.analysis.gravity, Vector3(0, 9.81, 0));
  EXPECT_EQ(scene.measure[0].drift->heights, (std::array<double, 2>{-1.0, 3.0}));
  EXPECT_EQ(scene.initial_stress.surface, 4.0);
  EXPECT_EQ(scene.water[0].level.point, Vector3(1, -2, 3));
  EXPECT_EQ(scene.water[0].level.normal, Vector3(0, -1, 0));
  EXPECT_EQ(scene.stage[0].water[0].level.point, Vector3(1, -2, 3));
  EXPECT_EQ(scene.stage[0].water[0].level.normal, Vector3(1, -1, 0));
}

TEST(ScenePlacement, InitialStressIsATensor) {
  const auto stress_of = [](const std::string& stress) {
    return placed(scene_of(statics + cube + "[initial_stress]\nstress = " + stress + "\n"), about_z())
        .initial_stress.stress;
  };
  // xx, yy, zz, xy, yz, zx
  const std::vector<double> turned = {2, 1, 3, -4, 6, -5};
  const SceneField numbers = stress_of("[1, 2, 3, 4, 5, 6]");
  EXPECT_EQ(numbers.at({0, 0, 0}), turned);
  EXPECT_EQ(std::get<double>(numbers.written[3]), -4.0);
  EXPECT_EQ(stress_of("[\"= x\", 2, 3, \"= y\", 5, 6]").at({1 - 4, 2 + 1, 0}), turned);
}

TEST(ScenePlacement, BoundariesAndTheirWaves) {
  const std::string text =
      start + "analysis = { end_time = 1, time_step = 0.1, gravity = [0, 0, 0] }\n" + cube + R"(
[[boundary]]
kind = "quiet"
plane = { point = [0, 0, 0], normal = [-1, 0, 0] }
wave = [[0, 0, 0, 0], [1, 1, 2, 3]]
[[boundary]]
kind = "quiet"
plane = { point = [0, 0, 0], normal = [0, 0, -1] }
wave = { file = "wave.csv", time = "t", values = ["v"] }
direction = [2, 0, 0]
[[boundary]]
kind = "quiet"
plane = { point = [0, 4, 0], normal = [0, 1, 0] }
wave = { file = "wave.csv", time = "t", values = ["v", "v", ""] }
)";
  const TemporaryFolder folder;
  write_text(folder / "wave.csv", "t,v\n0,0\n1,3\n");
  const Scene scene = placed(scene_of(text, (folder.path() / "scene.toml").string()), about_z());
  EXPECT_EQ(scene.boundary[0].plane.point, Vector3(1, 2, 3));
  EXPECT_EQ(scene.boundary[0].plane.normal, Vector3(0, -1, 0));
  EXPECT_EQ(scene.boundary[0].wave[1].value, Vector3(-2, 1, 3));
  EXPECT_EQ(*scene.boundary[1].direction, Vector3(0, 2, 0));
  EXPECT_EQ(scene.boundary[1].wave[1].value, Vector3(0, 3, 0));
  EXPECT_TRUE(scene.boundary[1].file);
  // Its rows have other components than the file.
  EXPECT_EQ(scene.boundary[2].wave[1].value, Vector3(-3, 3, 0));
  EXPECT_FALSE(scene.boundary[2].file);
}

TEST(ScenePlacement, Cuts) {
  const std::string text = statics + cube + R"(
[[cut]]
name = "p"
blocks = ["A"]
dip = 30
dip_direction = 90
point = [1, 2, 3]
spacing = 1
[[cut]]
name = "s"
blocks = ["A"]
solid = { sphere = { center = [1, 2, 3], radius = 1, subdivisions = 0 } }
)";
  Scene scene = placed(scene_of(text), about_z());
  EXPECT_NEAR(scene.cut[0].dip, 30.0, 1e-12);
  EXPECT_EQ(scene.cut[0].dip_direction, 0.0);
  EXPECT_EQ(scene.cut[0].point, Vector3(-1, 3, 6));
  EXPECT_EQ(std::get<SceneHull>(scene.cut[1].solid).points.size(), 12U);
  // Its normal (1/2, 0, cos 30) becomes (1/2, -cos 30, 0), a vertical plane.
  scene = placed(scene_of(text), about_x());
  EXPECT_NEAR(scene.cut[0].dip, 90.0, 1e-12);
  EXPECT_NEAR(scene.cut[0].dip_direction, 150.0, 1e-12);
  // Turned over, the side above is below.
  ScenePlacement over;
  over.turn << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  scene = placed(scene_of(text), over);
  EXPECT_NEAR(scene.cut[0].dip, 150.0, 1e-12);
  EXPECT_NEAR(scene.cut[0].dip_direction, 90.0, 1e-12);
}

/// Pieces keep their names.
TEST(ScenePlacement, PiecesAreThoseOfTheScene) {
  const TemporaryFolder folder;
  write_text(folder / "scene.toml", statics + "contact = { friction_angle = 30 }\n" + cube + R"(
[[cut]]
name = "p"
blocks = ["A"]
dip = 40
dip_direction = 120
spacing = { mean = 1, deviation = 0.3 }
persistence = 0.7
[[cut]]
name = "v"
blocks = ["B"]
voronoi = { count = 9 }
[[block]]
name = "B"
material = "rock"
box = { min = [4, 0, 0], max = [6, 4, 6] }
)");
  Diagnostics faults;
  const ScenePlacement placement = about_x();
  const auto here = load_scene(folder.path() / "scene.toml", {}, faults);
  const auto there =
      load_scene(folder.path() / "scene.toml", {}, faults, nullptr, LoadPurpose::run, 1, &placement);
  ASSERT_TRUE(faults.good());
  ASSERT_EQ(here->solids.size(), there->solids.size());
  EXPECT_GT(here->solids.size(), 12U);
  for (std::size_t k = 0; k < here->solids.size(); ++k) {
    EXPECT_EQ(here->scene.block[k].name, there->scene.block[k].name);
    EXPECT_NEAR(here->solids[k].volume(), there->solids[k].volume(), 1e-12);
  }
}

TEST(ScenePlacement, TheOriginFollowsTheBlocks) {
  ScenePlacement far = about_z();
  far.shift = {500000.0, 5300000.0, 400.0};
  Diagnostics faults;
  const Scene scene = placed(scene_of(statics + cube + "fix = [{ point = [2, 4, 6] }]\n"), far);
  EXPECT_EQ(scene.origin, Vector3(500000.0, 5300000.0, 400.0));
  EXPECT_EQ(std::get<Vector3>(scene.block[0].fix[0].where), Vector3(-4, 2, 6));
  EXPECT_EQ(to_json(scene)["block"][0]["fix"][0]["point"], (std::vector<double>{499996.0, 5300002.0, 406.0}));
  // And back.
  ScenePlacement back;
  back.turn = far.turn.transpose();
  back.shift = -(back.turn * far.shift);
  const Scene returned = placed(scene, back);
  EXPECT_EQ(returned.origin, Vector3::Zero());
  EXPECT_EQ(std::get<Vector3>(returned.block[0].fix[0].where), Vector3(2, 4, 6));
}

}  // namespace
}  // namespace ashlar::scene_placement_test
