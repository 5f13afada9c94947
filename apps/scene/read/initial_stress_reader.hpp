// Reads [initial_stress] of a scene.
#pragma once

#include "apps/scene/model/scene.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// @param table empty if it is not given. Faults go to its diagnostics
[[nodiscard]] SceneInitialStress read_initial_stress(TomlTableReader& table, bool given);

}  // namespace ashlar
