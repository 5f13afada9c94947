// Reads one [[load]] of a scene.
#pragma once

#include "apps/scene/model/scene_moving_load.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// Faults go to the table's diagnostics; the path is then empty.
[[nodiscard]] SceneMovingLoad read_moving_load(TomlTableReader& table);

}  // namespace ashlar
