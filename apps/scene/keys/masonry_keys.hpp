// Keys of [[masonry]]: those of all kinds, and those of each.
#pragma once

#include "apps/scene/keys/table_keys.hpp"
#include "apps/scene/masonry/masonry_kinds.hpp"

namespace ashlar::keys {

[[nodiscard]] const Keys<SceneMasonry>& masonry_keys();
[[nodiscard]] const Keys<SceneWall>& wall_keys();
[[nodiscard]] const Keys<SceneArch>& arch_keys();
[[nodiscard]] const Keys<SceneColumn>& column_keys();
[[nodiscard]] const Keys<SceneDome>& dome_keys();
/// The keys of all kinds of masonry in one table, to be described.
[[nodiscard]] const TableKeys& any_masonry_keys();

}  // namespace ashlar::keys
