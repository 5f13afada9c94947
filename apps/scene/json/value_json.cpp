#include "apps/scene/json/value_json.hpp"

#include <variant>

namespace ashlar {

using Json = nlohmann::ordered_json;

Json to_json(const Vector3& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

Json to_json(const SceneRecord& record) {
  Json json = {{"file", record.file.string()}};
  if (!record.time.empty()) json["time"] = record.time;
  json["values"] = record.values;
  json["scale"] = record.scale;
  if (record.baseline) json["baseline"] = *record.baseline;
  if (record.resample) json["resample"] = *record.resample;
  json["sha256"] = record.sha256;
  return json;
}

Json to_json(const SceneField& field) {
  Json json = Json::array();
  for (const auto& component : field.written)
    std::visit([&](const auto& value) { json.push_back(value); }, component);
  return json;
}

}  // namespace ashlar
