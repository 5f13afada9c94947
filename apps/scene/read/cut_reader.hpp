// Reads one [[cut]] of a scene.
#pragma once

#include "apps/scene/model/scene.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// Faults go to the table's diagnostics.
[[nodiscard]] SceneCut read_cut(TomlTableReader& table);

}  // namespace ashlar
