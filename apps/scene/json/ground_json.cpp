#include "apps/scene/json/ground_json.hpp"

#include <utility>
#include <variant>

#include "apps/scene/json/analysis_json.hpp"
#include "apps/scene/model/scene_names.hpp"

namespace ashlar {

using Json = nlohmann::ordered_json;

Json to_json(const SceneField& field) {
  Json json = Json::array();
  for (const auto& component : field.written)
    std::visit([&](const auto& value) { json.push_back(value); }, component);
  return json;
}

Json to_json(const SceneInitialStress& initial) {
  Json json = Json::object();
  if (initial.stress.given()) {
    json["stress"] = to_json(initial.stress);
  } else {
    json["k0"] = *initial.k0;
    json["surface"] = initial.surface;
    if (initial.unit_weight) json["unit_weight"] = *initial.unit_weight;
  }
  json["blocks"] = initial.blocks;
  return json;
}

Json to_json(const SceneWater& water) {
  Json level = water.file
                   ? Json{{"file", water.file->file.string()}, {"sha256", water.file->sha256}}
                   : Json{{"point", to_json(water.level.point)}, {"normal", to_json(water.level.normal)}};
  return {{"name", water.name},
          {"level", std::move(level)},
          {"unit_weight", water.unit_weight},
          {"joints", water.joints},
          {"faces", water.faces}};
}

Json to_json(const SceneBoundary& boundary) {
  Json json = {
      {"plane", {{"point", to_json(boundary.plane.point)}, {"normal", to_json(boundary.plane.normal)}}},
      {"kind", name_of(boundary_kind_names, boundary.kind)}};
  if (boundary.file) {
    json["wave"] = to_json(*boundary.file);
    if (boundary.direction) json["direction"] = to_json(*boundary.direction);
  } else if (!boundary.wave.empty()) {
    json["wave"] = Json::array();
    for (const auto& [time, value] : boundary.wave)
      json["wave"].push_back({time, value.x(), value.y(), value.z()});
  }
  return json;
}

}  // namespace ashlar
