// Reads the formulation of a scene, which determines some keys of [contact].
#pragma once

#include "apps/scene/model/scene.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// Reads `formulation`. Faults go to the table's diagnostics.
/// @param table [analysis], of the scene or of a stage
void read_formulation(TomlTableReader& table, SceneAnalysis& analysis);

/// Sets the keys of [contact] that the formulation determines: "incremental" and "paper" have flat sub-faces, "paper" has
/// point springs. Reports such a key that was given with another value.
/// @param scene whose analysis and [contact] have been read
void imply_contact(Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar
