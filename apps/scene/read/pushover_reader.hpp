// Reads the keys of [analysis] that a pushover has: pushover and spectrum.
#pragma once

#include "apps/scene/model/scene_analysis.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// Reads `pushover` and `spectrum`, whatever the type of the analysis. Faults go to the table's diagnostics.
/// @param table [analysis], of the scene or of a stage. @param analysis whose type has been read
void read_pushover(TomlTableReader& table, SceneAnalysis& analysis);

}  // namespace ashlar
