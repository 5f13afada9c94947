// A JSON schema of scenes, for editors and validators: recorded while the reader reads a scene with every table.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace ashlar {

/// A scene with a table of each kind and all variants of tables, each with the keys that have no default.
[[nodiscard]] std::string scene_with_every_table();

/// JSON schema (draft 2020-12). It covers keys, types, ranges, words and required keys of tables; checks that involve
/// several keys are left to `ashlar check`. Any number may be the text of a formula, "= 2*h".
[[nodiscard]] nlohmann::ordered_json scene_schema();

}  // namespace ashlar
