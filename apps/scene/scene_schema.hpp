// A JSON schema of scenes, for editors and validators: noted from the reader as it reads a scene with every table.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace ashlar {

/// A scene with a table of each kind and with all that a table may be, each with the keys that have no default.
[[nodiscard]] std::string scene_with_every_table();

/// JSON schema (draft 2020-12). It knows keys, types, ranges, words and what is required wherever the table stands;
/// what needs more than one key is left to `ashlar check`. Any number may be the text of a formula, "= 2*h".
[[nodiscard]] nlohmann::ordered_json scene_schema();

}  // namespace ashlar
