// Reads one [[cut]] of a scene.
#pragma once

#include "apps/scene/scene.hpp"
#include "apps/scene/toml_table_reader.hpp"

namespace ashlar {

/// Faults go to the table's diagnostics.
[[nodiscard]] SceneCut read_cut(TomlTableReader& table);

}  // namespace ashlar
