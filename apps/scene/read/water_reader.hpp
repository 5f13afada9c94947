// Reads one [[water]] of a scene.
#pragma once

#include "apps/scene/model/scene.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// Faults go to the table's diagnostics; a level that is missing or faulty is not finite.
[[nodiscard]] SceneWater read_water(TomlTableReader& table);

}  // namespace ashlar
