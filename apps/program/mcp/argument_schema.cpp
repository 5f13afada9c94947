#include "apps/program/mcp/argument_schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "apps/results/text/json_text.hpp"
#include "apps/scene/model/nearest_name.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> texts_in(const Json& list) {
  return list.get<std::vector<std::string>>();
}

/// "a whole number from 1 to 20"
std::string allowed_by(const Json& schema) {
  if (schema.contains("enum")) return fmt::format("one of {}", fmt::join(texts_in(schema["enum"]), ", "));
  const Json& type = schema["type"];
  if (type.is_array()) return "a text, a number, true or false";
  if (type == "string")
    return fmt::format("a text of at most {} bytes", schema["maxLength"].get<std::size_t>());
  if (type == "integer" || type == "number")
    return fmt::format("a{} number from {} to {}", type == "integer" ? " whole" : "",
                       schema["minimum"].dump(), schema["maximum"].dump());
  if (type == "boolean") return "true or false";
  if (type == "array")
    return fmt::format("a list of at most {} texts", schema["maxItems"].get<std::size_t>());
  return "an object";
}

bool fits(const Json& schema, const Json& value);

bool all_fit(const Json& schema, const Json& values) {
  return std::all_of(values.begin(), values.end(), [&](const Json& value) { return fits(schema, value); });
}

bool is_whole(const Json& value) {
  if (value.is_number_integer()) return true;
  // 3.0 is a whole number in JSON Schema.
  return value.is_number_float() && value.get<double>() == std::floor(value.get<double>());
}

bool fits(const Json& schema, const Json& value) {
  const Json& type = schema["type"];
  if (type.is_array()) return value.is_string() || value.is_number() || value.is_boolean();
  if (type == "string") {
    if (!value.is_string()) return false;
    if (schema.contains("enum"))
      return std::find(schema["enum"].begin(), schema["enum"].end(), value) != schema["enum"].end();
    return value.get_ref<const std::string&>().size() <= schema["maxLength"].get<std::size_t>();
  }
  if (type == "integer" || type == "number") {
    if (!value.is_number() || (type == "integer" && !is_whole(value))) return false;
    const auto number = value.get<double>();
    return number >= schema["minimum"].get<double>() && number <= schema["maximum"].get<double>();
  }
  if (type == "boolean") return value.is_boolean();
  if (type == "array")
    return value.is_array() && value.size() <= schema["maxItems"].get<std::size_t>() &&
           all_fit(schema["items"], value);
  return value.is_object() && all_fit(schema["additionalProperties"], value);
}

/// The beginning of a value, for messages.
std::string shown_value(const Json& value) {
  constexpr std::size_t most = 100;
  const std::string text = json_text(value);
  return text.size() <= most ? text : text.substr(0, most) + "...";
}

}  // namespace

Json text_argument(const std::string& meaning, std::size_t most) {
  return {{"type", "string"}, {"description", meaning}, {"maxLength", most}};
}

Json word_argument(const std::string& meaning, const std::vector<std::string>& words) {
  return {{"type", "string"}, {"description", meaning}, {"enum", words}};
}

Json whole_number_argument(const std::string& meaning, std::int64_t low, std::int64_t high) {
  return {{"type", "integer"}, {"description", meaning}, {"minimum", low}, {"maximum", high}};
}

Json number_argument(const std::string& meaning, double low, double high) {
  return {{"type", "number"}, {"description", meaning}, {"minimum", low}, {"maximum", high}};
}

Json flag_argument(const std::string& meaning) {
  return {{"type", "boolean"}, {"description", meaning}};
}

Json texts_argument(const std::string& meaning, std::size_t most) {
  return {{"type", "array"},
          {"description", meaning},
          {"maxItems", most},
          {"items", {{"type", "string"}, {"maxLength", 1000}}}};
}

Json settings_argument(const std::string& meaning) {
  return {{"type", "object"},
          {"description", meaning},
          {"additionalProperties", {{"type", {"string", "number", "boolean"}}}}};
}

Json arguments_schema(std::initializer_list<std::pair<const char*, Json>> properties,
                      const std::vector<std::string>& required) {
  Json schema = {{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
  for (const auto& [name, property] : properties) schema["properties"][name] = property;
  if (!required.empty()) schema["required"] = required;
  return schema;
}

std::string fault_of_arguments(const Json& schema, const Json& arguments) {
  const Json& properties = schema["properties"];
  std::vector<std::string> names;
  for (const auto& property : properties.items()) names.push_back(property.key());
  for (const auto& [name, value] : arguments.items()) {
    const auto property = properties.find(name);
    if (property == properties.end()) {
      return names.empty() ? fmt::format("unknown argument ({}), none is allowed", name)
                           : fmt::format("unknown argument ({}), {}one of {} is allowed", name,
                                         guess(name, names), fmt::join(names, ", "));
    }
    if (!fits(*property, value))
      return fmt::format("{} is {}, {} is needed", name, shown_value(value), allowed_by(*property));
  }
  if (!schema.contains("required")) return "";
  for (const std::string& name : texts_in(schema["required"]))
    if (!arguments.contains(name))
      return fmt::format("{} is missing, {} is needed", name, allowed_by(properties[name]));
  return "";
}

}  // namespace ashlar
