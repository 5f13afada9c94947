// Supports and loads of blocks: [[block.fix]], [[block.load]], and those of other tables.
#pragma once

#include <vector>

#include "apps/scene/keys/values.hpp"
#include "apps/scene/model/scene_block.hpp"

namespace ashlar::keys {

[[nodiscard]] const Keys<SceneFix>& fix_keys();
[[nodiscard]] const Keys<SceneLoad>& load_keys();

// Parts of tables that have more keys.
[[nodiscard]] std::vector<Key<SceneFix>> keys_of_fix();
bool check_fix(TomlTableReader& table, SceneFix& fix);
[[nodiscard]] std::vector<Key<SceneLoad>> keys_of_load();
bool check_load(TomlTableReader& table, SceneLoad& load);

}  // namespace ashlar::keys
