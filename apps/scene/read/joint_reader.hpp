// Reads [contact] and one [[joint]] of a scene.
#pragma once

#include "apps/scene/model/scene.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// Faults go to the table's diagnostics.
void read_contact(TomlTableReader table, SceneContact& contact);
/// Blocks that are missing or faulty are empty.
[[nodiscard]] SceneJoint read_joint(TomlTableReader& table);

}  // namespace ashlar
