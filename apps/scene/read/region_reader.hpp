// Blocks chosen by place: the key `inside`, and lists of blocks with it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/model/scene_region.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// inside = { box | mesh | hull | sphere | halfspace = { point, normal } }, exactly one of them. Faults go to the
/// table's diagnostics. @return empty if the key is absent or faulty
[[nodiscard]] std::optional<SceneRegion> read_inside(TomlTableReader& table);

/// A list of names and globs: an array of texts, or { blocks, inside }, whose blocks are "*" if they are left out.
/// @param inside empty unless the second form is given
void read_block_list(TomlTableReader& table, std::string_view key, std::vector<std::string>& names,
                     std::optional<SceneRegion>& inside);

/// The key `blocks` of a table that may have `inside`: required without it, otherwise "*" if left out.
void read_blocks_or_inside(TomlTableReader& table, std::vector<std::string>& names,
                           std::optional<SceneRegion>& inside);

}  // namespace ashlar
