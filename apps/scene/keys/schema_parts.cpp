#include "apps/scene/keys/schema_parts.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace ashlar::keys {

using Json = nlohmann::ordered_json;

Json schema_of_number(const NumberRange& range, const char* type) {
  Json json = {{"type", type}};
  if (std::isfinite(range.low)) json[range.low_allowed ? "minimum" : "exclusiveMinimum"] = range.low;
  const bool limited = std::isfinite(range.high) && range.high < std::numeric_limits<int>::max();
  if (limited) json[range.high_allowed ? "maximum" : "exclusiveMaximum"] = range.high;
  const Json formula = {{"type", "string"}, {"pattern", "^\\s*="}};
  return {{"anyOf", Json::array({std::move(json), formula})}};
}

Json schema_of_array(Json items, std::size_t least) {
  Json json = {{"type", "array"}, {"items", std::move(items)}};
  if (least > 0) json["minItems"] = least;
  return json;
}

Json schema_of_row(std::size_t width) {
  Json json = schema_of_array(schema_of_number(range::any_number, "number"), width);
  json["maxItems"] = width;
  return json;
}

Json schema_of_text() {
  return {{"type", "string"}};
}

Json schema_of_record() {
  const Json text = schema_of_text();
  const Json number = schema_of_number(range::any_number, "number");
  return {{"type", "object"},
          {"properties",
           {{"file", text},
            {"time", text},
            {"values", schema_of_array(text, 1)},
            {"scale", {{"anyOf", Json::array({number, Json{{"const", "g"}}})}}},
            {"baseline", {{"enum", Json::array({0, 1, 2, 3})}}},
            {"resample", schema_of_number(range::positive, "number")}}},
          {"required", Json::array({"file", "values"})},
          {"additionalProperties", false}};
}

Json schema_of_any(std::vector<Json> forms) {
  return {{"anyOf", std::move(forms)}};
}

}  // namespace ashlar::keys
