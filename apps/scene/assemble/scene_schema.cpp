#include "apps/scene/assemble/scene_schema.hpp"

#include <utility>

#include "apps/scene/keys/scene_keys.hpp"
#include "apps/scene/keys/schema_parts.hpp"

namespace ashlar {

using Json = nlohmann::ordered_json;

Json scene_schema() {
  Json json = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Ashlar scene"}};
  json.update(keys::top_keys().table().schema());
  Json& properties = json["properties"];
  // These two are read before all tables.
  properties["include"] = keys::schema_of_array(keys::schema_of_text(), 0);
  properties["parameters"] = {{"type", "object"},
                              {"additionalProperties", keys::schema_of_number(range::any_number, "number")}};
  for (const keys::SceneTable& table : keys::all_tables()) {
    const bool inside_another = table.heading.empty() || table.heading.find('.') != std::string::npos;
    if (inside_another) continue;
    Json schema = table.keys.schema();
    properties[table.heading] = table.list ? keys::schema_of_array(std::move(schema), 0) : std::move(schema);
  }
  return json;
}

Json scene_reference() {
  Json json = Json::object();
  for (const keys::SceneTable& table : keys::all_tables()) json[table.heading] = table.keys.rows();
  return json;
}

}  // namespace ashlar
