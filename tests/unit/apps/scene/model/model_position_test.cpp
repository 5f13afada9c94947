#include "apps/scene/model/model_position.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "apps/scene/assemble/scene_reader.hpp"
#include "apps/scene/assemble/scene_schema.hpp"
#include "apps/scene/json/scene_json.hpp"

namespace ashlar::model_position_test {
namespace {

using ::testing::IsEmpty;

/// Keys with three numbers that are positions, and those that are directions, sizes or rates.
const std::set<std::string> positions = {"assign.fix.plane.point",
                                         "assign.fix.point",
                                         "assign.inside.box.max",
                                         "assign.inside.box.min",
                                         "assign.inside.halfspace.point",
                                         "assign.inside.hull.points",
                                         "assign.inside.sphere.center",
                                         "assign.load.plane.point",
                                         "assign.load.point",
                                         "block.box.max",
                                         "block.box.min",
                                         "block.fix.plane.point",
                                         "block.fix.point",
                                         "block.hull.points",
                                         "block.load.plane.point",
                                         "block.load.point",
                                         "block.rotate.about",
                                         "block.sphere.center",
                                         "block.translate",
                                         "bolt.from",
                                         "bolt.pattern.plane.point",
                                         "bolt.to",
                                         "boundary.plane.point",
                                         "cut.point",
                                         "cut.solid.box.max",
                                         "cut.solid.box.min",
                                         "cut.solid.hull.points",
                                         "cut.solid.sphere.center",
                                         "masonry.center",
                                         "masonry.origin",
                                         "measure.point",
                                         "prop.from",
                                         "prop.to",
                                         "stage.bolt.from",
                                         "stage.bolt.pattern.plane.point",
                                         "stage.bolt.to",
                                         "stage.fix.plane.point",
                                         "stage.fix.point",
                                         "stage.load.plane.point",
                                         "stage.load.point",
                                         "stage.prop.from",
                                         "stage.prop.to",
                                         "stage.water.level.point",
                                         "water.level.point"};
/// The last part of their names.
const std::set<std::string> other_vectors = {"normal", "axis",     "velocity", "angular_velocity",
                                             "force",  "traction", "gravity",  "direction",
                                             "step",   "stagger",  "brick"};
/// Sides of an opening are measured along the wall.
const std::set<std::string> other_keys = {"masonry.openings.box.min", "masonry.openings.box.max"};

bool is_row(const nlohmann::ordered_json& schema) {
  return schema.value("maxItems", 0) == 3;
}

/// Adds the names of keys with three numbers, or rows of them.
void add_vectors(const nlohmann::ordered_json& table, const std::string& path,
                 std::vector<std::string>& names) {
  for (const auto& [key, value] : table["properties"].items()) {
    const std::string name = path.empty() ? key : path + "." + key;
    for (const nlohmann::ordered_json& form : value.value("anyOf", nlohmann::ordered_json::array({value}))) {
      const nlohmann::ordered_json items = form.value("items", nlohmann::ordered_json::object());
      if (is_row(form) || is_row(items)) names.push_back(name);
      if (form.contains("properties")) add_vectors(form, name, names);
      if (items.contains("properties")) add_vectors(items, name, names);
    }
  }
}

TEST(ModelPosition, EveryVectorOfASceneIsAPositionOrIsNot) {
  std::vector<std::string> names;
  add_vectors(scene_schema(), "", names);
  std::set<std::string> found;
  std::vector<std::string> unknown;
  for (std::string name : names) {
    // Regions are alike in all tables.
    if (const std::size_t region = name.find(".inside."); region != std::string::npos)
      name.replace(0, region, "assign");
    if (positions.contains(name))
      found.insert(name);
    else if (!other_vectors.contains(name.substr(name.rfind('.') + 1)) && !other_keys.contains(name))
      unknown.push_back(name);
  }
  EXPECT_THAT(unknown, IsEmpty());
  EXPECT_EQ(found, positions);
}

/// A position, by parameters.
std::string at(double x, double y, double z) {
  return fmt::format("[\"= {} + sx\", \"= {} + sy\", \"= {} + sz\"]", x, y, z);
}

/// A scene with every position, about the place (sx, sy, sz). Its blocks are centred there.
std::string scene_text() {
  const std::string plane = fmt::format("plane = {{ point = {}, normal = [0, 0, 1] }}", at(0, 0, 1));
  const std::string box = fmt::format("box = {{ min = {}, max = {} }}", at(-1, -1, -1), at(1, 1, 1));
  const std::string hull = fmt::format("hull = {{ points = [{}, {}, {}, {}] }}", at(-4, -4, -4),
                                       at(-3, -4, -4), at(-4, -3, -4), at(-4, -4, -3));
  const std::string sphere = fmt::format("sphere = {{ center = {}, radius = 0.5 }}", at(3, 3, 3));
  const std::string water =
      fmt::format("level = {{ point = {}, normal = [0, 0, 1] }}, unit_weight = 1", at(0, 0, 2));
  std::string text = R"(analysis = { type = "static" }
parameters = { sx = 0, sy = 0, sz = 0 }
material = [{ name = "rock", density = 1, young_modulus = 1, poisson_ratio = 0 }]
)";
  const auto add = [&](const std::string& table, const std::string& content) {
    text += fmt::format("[[{}]]\n{}\n", table, content);
  };
  add("block", "name = \"A\"\nmaterial = \"rock\"\n" + box);
  add("block.fix", plane);
  add("block.fix", "point = " + at(0.5, 0.5, 0.5));
  add("block.load", plane + "\ntraction = [\"= x - sx\", \"= y - sy\", \"= z - sz\"]");
  add("block.load", "point = " + at(0.5, 0.5, 0.5) + "\nforce = [0, 0, 1]");
  add("block", "name = \"B\"\nmaterial = \"rock\"\nrotate = { axis = [0, 0, 1], angle = 90, about = " +
                   at(-3, -3, -3) + " }\n" + hull);
  add("block",
      "name = \"C\"\nmaterial = \"rock\"\narray = { count = [2], step = [[0, 0, -1.5]] }\n" + sphere);
  add("block",
      "name = \"D\"\nmaterial = \"rock\"\nbox = { min = [-0.5, -0.5, -0.5], max = [0.5, 0.5, 0.5] }\n"
      "translate = " +
          at(3, -3, 3));
  add("masonry",
      "name = \"wall\"\nkind = \"wall\"\nmaterial = \"rock\"\nlength = 1\nheight = 1\nbrick = [1, 1, 1]\n"
      "origin = " +
          at(-4, 3, -4));
  add("masonry",
      "name = \"arch\"\nkind = \"arch\"\nmaterial = \"rock\"\nradius = 1.5\nthickness = 1\nwidth = 1\n"
      "voussoirs = 3\nfill = { top = \"= 3 + sz\", weight = 1 }\ncenter = " +
          at(2, 0, 0));
  add("assign", "blocks = [\"A\"]\ninside = { " + box + " }\nfix = [{ point = " + at(0.5, 0.5, -0.5) +
                    " }]\nload = [{ " + plane + ", force = [0, 0, 1] }]");
  add("assign", "blocks = [\"A\"]\norder = 1\ninside = { halfspace = { point = " + at(0, 0, 9) +
                    ", normal = [0, 0, 1] } }");
  add("cut", "name = \"p\"\nblocks = [\"A\"]\ndip = 0\ndip_direction = 0\npoint = " + at(0, 0, 0.25));
  add("cut", "name = \"s\"\nblocks = [\"A\"]\nsolid = { " + box + " }");
  add("bolt", "name = \"b\"\narea = 1\nbond_stiffness = 1\nfrom = " + at(0, 0, 1) + "\nto = " + at(0, 0, -1));
  add("bolt", "name = \"c\"\narea = 1\nbond_stiffness = 1\npattern = { spacing = [1, 1], length = 1, " +
                  plane + " }");
  add("prop", "name = \"q\"\nstiffness = 1\nfrom = " + at(0, 0, 1) + "\nto = " + at(0, 0, -1));
  add("load",
      "force = [0, 0, -1]\npath = [[0, \"= 1 + sx\", \"= sy\", \"= sz\"], [1, \"= 2 + sx\", \"= sy\", \"= "
      "sz\"]]");
  add("measure", "name = \"m\"\nblock = \"A\"\npoint = " + at(0.5, 0.5, 0.5));
  add("measure", "name = \"d\"\ndrift = { blocks = [\"A\"], heights = [\"= sz - 0.5\", \"= sz + 0.5\"] }");
  add("water", "name = \"w\"\n" + water.substr(0, water.find(", unit")) + "\nunit_weight = 1");
  text += "[initial_stress]\nk0 = 1\nsurface = \"= 2 + sz\"\n";
  add("boundary", "kind = \"quiet\"\n" + plane);
  add("stage", "name = \"one\"\nwater = [{ name = \"v\", " + water +
                   " }]\nfix = [{ blocks = [\"A\"], point = " + at(0.5, 0.5, 0.5) +
                   " }]\nload = [{ blocks = [\"A\"], " + plane +
                   ", force = [0, 0, 1] }]\nprop = [{ name = \"r\", stiffness = 1, from = " + at(0, 0, 1) +
                   ", to = " + at(0, 0, -1) + " }]\nadd = { inside = { " + sphere + " } }");
  return text;
}

Scene scene_at(const Vector3& place, Diagnostics& diagnostics) {
  return parse_scene(scene_text(), "scene.toml",
                     {fmt::format("parameters.sx={}", place.x()), fmt::format("parameters.sy={}", place.y()),
                      fmt::format("parameters.sz={}", place.z())},
                     diagnostics);
}

TEST(ModelPosition, ASceneFarAwayIsTheSceneAtTheOrigin) {
  Diagnostics faults;
  const Scene near = scene_at(Vector3::Zero(), faults);
  const Vector3 place(0x1p19, -0x1p22, 0x1p9);  // exact with all of the scene's coordinates
  Scene far = scene_at(place, faults);
  for (const Diagnostic& fault : faults.sorted()) ADD_FAILURE() << fault.message;
  ASSERT_EQ(near.origin, Vector3::Zero());
  ASSERT_EQ(far.origin, place);
  // All coordinates as the user gave them.
  Scene given = near;
  given.origin = place;
  EXPECT_EQ(to_json(given)["cut"], to_json(far)["cut"]);
  const Vector3 somewhere(0.25, 0.5, 1.0);
  EXPECT_EQ(far.block[0].load[0].field.at(somewhere), near.block[0].load[0].field.at(somewhere));
  EXPECT_EQ(far.initial_stress.surface, near.initial_stress.surface);
  far.origin.setZero();
  auto of_far = to_json(far), of_near = to_json(near);
  // The formula as it was written: its parameters have other values.
  for (auto* json : {&of_far, &of_near}) (*json)["block"][0]["load"][0].erase("traction");
  EXPECT_EQ(of_far, of_near);
  // Regions are not in JSON.
  const auto box_of_assign = [](const Scene& scene) {
    return std::get<SceneBox>(std::get<SceneShape>(scene.assign[0].inside->space)).min;
  };
  EXPECT_EQ(box_of_assign(far), box_of_assign(near));
  EXPECT_EQ(std::get<SceneHalfspace>(far.assign[1].inside->space).point,
            std::get<SceneHalfspace>(near.assign[1].inside->space).point);
  EXPECT_EQ(std::get<Vector3>(far.assign[0].fix[0].where), std::get<Vector3>(near.assign[0].fix[0].where));
}

TEST(ModelPosition, JsonHasTheUsersCoordinates) {
  Diagnostics faults;
  const Vector3 place(500000.0, 5300000.0, 400.0);
  const auto json = to_json(scene_at(place, faults));
  ASSERT_TRUE(faults.good());
  const std::vector<double> low = {499999.0, 5299999.0, 399.0};
  EXPECT_EQ(json["block"][0]["box"]["min"], low);
  EXPECT_EQ(json["block"][0]["fix"][1]["point"], (std::vector<double>{500000.5, 5300000.5, 400.5}));
  EXPECT_EQ(json["prop"][0]["to"], (std::vector<double>{500000.0, 5300000.0, 399.0}));
  EXPECT_EQ(json["initial_stress"]["surface"], 402.0);
  EXPECT_EQ(json["measure"][1]["drift"]["heights"], (std::vector<double>{399.5, 400.5}));
}

TEST(ModelPosition, OriginsAreFarFromTheUsersAndSubtractedExactly) {
  const auto around = [](const Vector3& center) {
    return origin_for(Box{center - Vector3(7.0, 2.0, 5.0), center + Vector3(7.0, 2.0, 5.0)});
  };
  EXPECT_EQ(around(Vector3::Zero()), Vector3::Zero());
  EXPECT_EQ(around({100.0, -100.0, 0.0}), Vector3::Zero());  // of a model of 14 m
  EXPECT_EQ(around({1e4, 0.0, -1e4}).y(), 0.0);
  EXPECT_EQ(origin_for({}), Vector3::Zero());
  for (const double center : {1e3, 12345.678, 5.3e6, -1e7, 1e12}) {
    const double origin = around(Vector3::Constant(center)).x();
    EXPECT_LE(std::abs(center - origin), 8.0) << center;
    for (const double share : {-1.0, -0.3333333, 0.1, 0.77777777}) {
      const double coordinate = center + 7.0 * share, difference = coordinate - origin;
      // Exact: both roundings of a sum of two doubles agree.
      EXPECT_EQ(difference + origin, coordinate);
      EXPECT_EQ(coordinate - difference, origin);
    }
  }
}

}  // namespace
}  // namespace ashlar::model_position_test
