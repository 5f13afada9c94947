// Reads one [[block]] of a scene: its shape, placement, supports and loads.
#pragma once

#include <string>

#include "apps/scene/model/scene.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// Faults go to the table's diagnostics. A shape that is missing, given twice, faulty or badly placed is empty;
/// faulty points and planes are not finite.
[[nodiscard]] SceneBlock read_block(TomlTableReader& table);

/// The part of it that says where the block is: its shape, rotate, translate and array. @param block with its name
void read_block_place(TomlTableReader& table, SceneBlock& block);

/// Reads `order`. A block without one has an automatic order until keep_given_orders.
void read_order(TomlTableReader& table, SceneBlock& block);

/// Without analysis.accuracy, blocks whose order is not given have order 1.
void keep_given_orders(Scene& scene);

/// Reads [[block.fix]] and [[block.load]], which other tables have too.
[[nodiscard]] SceneFix read_fix(TomlTableReader& table);
[[nodiscard]] SceneLoad read_load(TomlTableReader& table);
/// Reports supports, loads and velocities of a fixed block.
void refuse_motion_if_fixed(TomlTableReader& table, const SceneBlock& block);
/// Keys of a mesh: `file` and `scale` only, or also those that divide and repair the file's content.
enum class MeshKeys { as_it_is, mending };
/// Reads the one of box, mesh, hull and sphere given by a table. @param what name of the table for messages
[[nodiscard]] SceneShape read_shape(TomlTableReader& table, const std::string& what, MeshKeys mesh);

}  // namespace ashlar
