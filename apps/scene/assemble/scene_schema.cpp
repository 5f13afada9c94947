#include "apps/scene/assemble/scene_schema.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "apps/scene/assemble/scene_reader.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

Json formula() {
  return {{"type", "string"}, {"pattern", "^\\s*="}};
}

/// A number in a range, or a formula for it.
Json number(const NumberRange& range, const char* type) {
  Json json = {{"type", type}};
  if (std::isfinite(range.low)) json[range.low_allowed ? "minimum" : "exclusiveMinimum"] = range.low;
  const bool limited = std::isfinite(range.high) && range.high < std::numeric_limits<int>::max();
  if (limited) json[range.high_allowed ? "maximum" : "exclusiveMaximum"] = range.high;
  return {{"anyOf", Json::array({std::move(json), formula()})}};
}

Json array_of(Json items, std::size_t least) {
  Json json = {{"type", "array"}, {"items", std::move(items)}};
  if (least > 0) json["minItems"] = least;
  return json;
}

Json row(std::size_t width) {
  Json json = array_of(number(range::any_number, "number"), width);
  json["maxItems"] = width;
  return json;
}

Json record() {
  const Json text = {{"type", "string"}};
  return {{"type", "object"},
          {"properties",
           {{"file", text},
            {"time", text},
            {"values", array_of(text, 1)},
            {"scale", {{"anyOf", Json::array({number(range::any_number, "number"), Json{{"const", "g"}}})}}},
            {"baseline", {{"enum", Json::array({0, 1, 2, 3})}}},
            {"resample", number(range::positive, "number")}}},
          {"required", Json::array({"file", "values"})},
          {"additionalProperties", false}};
}

class SchemaMaker {
 public:
  explicit SchemaMaker(const KeyRecorder& recorder) : recorder_(recorder) {}

  /// @param name of the table, "" for the top
  Json of_table(const std::string& name) const {
    const KeyRecorder::Table& table = recorder_.tables().at(name);
    Json properties = Json::object();
    for (const auto& [key, forms] : table.keys) properties[key] = of_key(name, key, forms);
    Json json = {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
    Json required = Json::array();
    for (const auto& [key, times] : table.required)
      if (times == table.read) required.push_back(key);
    if (!required.empty()) json["required"] = std::move(required);
    return json;
  }

 private:
  Json of_key(const std::string& name, const std::string& key, const std::vector<KeyForm>& forms) const {
    std::vector<Json> choices;
    for (const KeyForm& form : forms) {
      Json json = of_form(name.empty() ? key : name + "." + key, form);
      if (std::find(choices.begin(), choices.end(), json) == choices.end())
        choices.push_back(std::move(json));
    }
    if (choices.empty()) return Json::object();
    if (choices.size() == 1) return choices.front();
    return {{"anyOf", choices}};
  }

  Json of_form(const std::string& child, const KeyForm& form) const {
    switch (form.kind) {
      case KeyForm::Kind::boolean:
        return {{"type", "boolean"}};
      case KeyForm::Kind::text:
        return {{"type", "string"}};
      case KeyForm::Kind::number:
        return number(form.range, "number");
      case KeyForm::Kind::whole_number:
        return number(form.range, "integer");
      case KeyForm::Kind::automatic:
        return {{"const", "auto"}};
      case KeyForm::Kind::word:
        return {{"enum", form.words}};
      case KeyForm::Kind::words:
        return array_of({{"enum", form.words}}, 0);
      case KeyForm::Kind::texts:
        return array_of({{"type", "string"}}, 0);
      case KeyForm::Kind::whole_numbers:
        return array_of(number(form.range, "integer"), 0);
      case KeyForm::Kind::row:
        return row(form.width);
      case KeyForm::Kind::rows:
        return array_of(row(form.width), form.minimum);
      case KeyForm::Kind::record:
        return record();
      case KeyForm::Kind::table:
        return of_child(child);
      case KeyForm::Kind::tables:
        return array_of(recorder_.tables().contains(child) ? of_table(child) : Json{{"type", "object"}}, 0);
    }
    return Json::object();
  }

  /// A table; regions and lists of blocks are alike in all tables, and recorded in [[assign]] alone.
  Json of_child(const std::string& child) const {
    if (recorder_.tables().contains(child)) return of_table(child);
    const Json inside = recorder_.tables().contains(region_table) ? of_table(region_table) : Json::object();
    if (child.ends_with(".inside")) return inside;
    if (child == "stage.remove" || child == "stage.add")
      return {{"type", "object"},
              {"properties", {{"blocks", array_of({{"type", "string"}}, 0)}, {"inside", inside}}},
              {"additionalProperties", false}};
    return {{"type", "object"}};
  }

  static constexpr const char* region_table = "assign.inside";

  const KeyRecorder& recorder_;
};

/// Tables of blocks and their materials, at the beginning of a scene.
constexpr const char* block_tables = R"([analysis]
end_time = 1
time_step = 1
[contact]
fracture_energy = { tension = 1, shear = 1 }
[[joint]]
blocks = ["A", "B"]
[[joint]]
cut = "set"
tied = { tension = 1, shear = 1 }
fracture_energy = { tension = 1, shear = 1 }
[[material]]
name = "rock"
density = 1
young_modulus = 1
poisson_ratio = 0
[[block]]
name = "A"
material = "rock"
box = { min = [0, 0, 0], max = [1, 1, 1] }
rotate = { axis = [0, 0, 1], angle = 0 }
array = { count = [1], step = [[1, 0, 0]] }
[[block.fix]]
plane = { point = [0, 0, 0], normal = [0, 0, 1] }
[[block.load]]
plane = { point = [0, 0, 0], normal = [0, 0, 1] }
traction = [0, 0, 0]
[[block]]
name = "B"
material = "rock"
mesh = { file = "b.off" }
[[block]]
name = "C"
material = "rock"
hull = { points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]] }
[[block]]
name = "D"
material = "rock"
sphere = { radius = 1 }
)";

constexpr const char* masonry_tables = R"([[masonry]]
name = "wall"
kind = "wall"
material = "rock"
length = 9
height = 9
brick = [1, 1, 1]
openings = [{ box = { min = [1, 0, 0], max = [2, 1, 1] }, lintel = { height = 1, bearing = 1 } }]
[[masonry]]
name = "arch"
kind = "arch"
radius = 1
thickness = 1
width = 1
voussoirs = 9
fill = { top = 9, weight = 1 }
[[masonry]]
name = "column"
kind = "column"
radius = 1
height = 1
drums = 1
[[masonry]]
name = "dome"
kind = "dome"
radius = 1
thickness = 1
courses = 1
voussoirs = 9
)";

constexpr const char* later_tables = R"([[assign]]
blocks = ["arch.*"]
[[assign]]
inside = { box = { min = [0, 0, 0], max = [1, 1, 1] } }
[[assign]]
inside = { mesh = { file = "b.off" } }
[[assign]]
inside = { hull = { points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]] } }
[[assign]]
inside = { sphere = { radius = 1 } }
[[assign]]
inside = { halfspace = { point = [0, 0, 0], normal = [0, 0, 1] } }
[[cut]]
name = "set"
blocks = ["A"]
dip = 0
dip_direction = 0
spacing = { mean = 1 }
bonded = { tensile_strength = 1, cohesion = 1, fracture_energy = { tension = 1, shear = 1 } }
[[cut]]
name = "inside a box"
blocks = ["A"]
solid = { box = { min = [0, 0, 0], max = [1, 1, 1] } }
[[cut]]
name = "inside a mesh"
blocks = ["A"]
solid = { mesh = { file = "b.off" } }
[[cut]]
name = "inside a hull"
blocks = ["A"]
solid = { hull = { points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]] } }
[[cut]]
name = "inside a sphere"
blocks = ["A"]
solid = { sphere = { radius = 1 } }
[[cut]]
name = "cells"
blocks = ["A"]
voronoi = { count = 2 }
bonded = { tensile_strength = 1, cohesion = 1 }
[[bolt]]
name = "bolt"
area = 1
bond_stiffness = 1
from = [0, 0, 0]
to = [0, 0, 1]
[[bolt]]
name = "row"
area = 1
bond_stiffness = 1
pattern = { plane = { point = [0, 0, 0], normal = [0, 0, 1] }, spacing = [1, 1], length = 1 }
[[prop]]
name = "prop"
stiffness = 1
from = [0, 0, 0]
to = [0, 0, 1]
[[cut]]
name = "measured"
blocks = ["A"]
file = "joints.csv"
[[load]]
force = [0, 0, -1]
path = [[0, 0, 0, 0], [1, 1, 0, 0]]
[[measure]]
name = "tip"
block = "A"
point = [0, 0, 0]
[[measure]]
name = "contact"
pair = ["A", "B"]
[[measure]]
name = "storey"
drift = { blocks = ["A"], heights = [0, 1] }
[[measure]]
name = "width"
crack = { joints = ["bed"], to = ["A"] }
[[water]]
level = { point = [0, 0, 0], normal = [0, 0, 1] }
unit_weight = 9810
[initial_stress]
k0 = 0.5
[[boundary]]
plane = { point = [0, 0, 0], normal = [0, 0, -1] }
kind = "quiet"
wave = [[0, 0, 0, 0]]
[[measure]]
name = "force"
bolt = "bolt"
[[stage]]
name = "all"
analysis = { end_time = 1 }
[output]
)";

}  // namespace

std::string scene_with_every_table() {
  return std::string(block_tables) + masonry_tables + later_tables;
}

Json scene_schema() {
  KeyRecorder recorder;
  record_keys(scene_with_every_table(), recorder);
  Json schema = SchemaMaker(recorder).of_table("");
  // These two are read before all tables.
  schema["properties"]["include"] = array_of({{"type", "string"}}, 0);
  schema["properties"]["parameters"] = {{"type", "object"},
                                        {"additionalProperties", number(range::any_number, "number")}};
  Json json = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Ashlar scene"}};
  json.update(schema);
  return json;
}

}  // namespace ashlar
