// Reads [[measure]].
#pragma once

#include "apps/scene/model/scene_measure.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// Exactly one of block (or inside), pair, bolt, drift and crack. Faults go to the table's diagnostics.
[[nodiscard]] SceneMeasure read_measure(TomlTableReader& table);

}  // namespace ashlar
