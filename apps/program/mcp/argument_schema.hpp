// Arguments of a tool: their JSON schema, as clients get it, and the check of arguments against the same schema.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ashlar {

/// Schema of a text. @param most its greatest length, bytes
[[nodiscard]] nlohmann::ordered_json text_argument(const std::string& meaning, std::size_t most = 1000);
/// Of one of some words.
[[nodiscard]] nlohmann::ordered_json word_argument(const std::string& meaning,
                                                   const std::vector<std::string>& words);
[[nodiscard]] nlohmann::ordered_json whole_number_argument(const std::string& meaning, std::int64_t low,
                                                           std::int64_t high);
[[nodiscard]] nlohmann::ordered_json number_argument(const std::string& meaning, double low, double high);
[[nodiscard]] nlohmann::ordered_json flag_argument(const std::string& meaning);
/// Of a list of texts.
[[nodiscard]] nlohmann::ordered_json texts_argument(const std::string& meaning, std::size_t most = 100);
/// Of an object whose values are texts, numbers, true or false.
[[nodiscard]] nlohmann::ordered_json settings_argument(const std::string& meaning);

/// Schema of all arguments. @param required names of those that must be given
[[nodiscard]] nlohmann::ordered_json arguments_schema(
    std::initializer_list<std::pair<const char*, nlohmann::ordered_json>> properties,
    const std::vector<std::string>& required = {});

/// Checks arguments by the parts of JSON Schema that the functions above use.
/// @return empty if they fit; otherwise "scene is missing, a text is needed", with the nearest name for an unknown one
[[nodiscard]] std::string fault_of_arguments(const nlohmann::ordered_json& schema,
                                             const nlohmann::ordered_json& arguments);

}  // namespace ashlar
