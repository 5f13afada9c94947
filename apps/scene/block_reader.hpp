// Reading one [[block]] of a scene: its shape, placing, supports and loads.
#pragma once

#include <string>

#include "apps/scene/scene.hpp"
#include "apps/scene/toml_table_reader.hpp"

namespace ashlar {

/// Faults go to the table's diagnostics. A shape that is missing, given twice, faulty or not placed well is
/// left empty; points and planes that are faulty are not finite.
[[nodiscard]] SceneBlock read_block(TomlTableReader& table);

/// One [[block.fix]] and one [[block.load]], which other tables have too.
[[nodiscard]] SceneFix read_fix(TomlTableReader& table);
[[nodiscard]] SceneLoad read_load(TomlTableReader& table);
/// Reports supports, loads and velocities of a block that never moves.
void refuse_motion_if_fixed(TomlTableReader& table, const SceneBlock& block);
/// Keys of a mesh: `file` and `scale` only, or also those that divide and mend what is in the file.
enum class MeshKeys { as_it_is, mending };
/// The one of box, mesh, hull and sphere that a table gives. @param what the table in words
[[nodiscard]] SceneShape read_shape(TomlTableReader& table, const std::string& what, MeshKeys mesh);

}  // namespace ashlar
