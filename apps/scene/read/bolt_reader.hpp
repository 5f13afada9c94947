// Reads [[bolt]] and [[prop]] (scene_bolt.hpp).
#pragma once

#include "apps/scene/model/scene_bolt.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// Places that are missing or faulty are not finite, so that no later check applies to them.
[[nodiscard]] SceneBolt read_bolt(TomlTableReader& table);
[[nodiscard]] SceneProp read_prop(TomlTableReader& table);

}  // namespace ashlar
