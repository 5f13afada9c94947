// Descriptions of all keys of a scene, made from their declarations (keys/scene_keys.hpp).
#pragma once

#include <nlohmann/json.hpp>

namespace ashlar {

/// JSON schema (draft 2020-12), for editors and validators. It covers keys, types, ranges, words and required keys of
/// tables; checks that involve several keys are left to `ashlar check`. Any number may be the text of a formula, "= 2*h".
[[nodiscard]] nlohmann::ordered_json scene_schema();

/// Rows of the reference by heading of the table, "" for the top of a scene (TableKeys::rows).
[[nodiscard]] nlohmann::ordered_json scene_reference();

}  // namespace ashlar
