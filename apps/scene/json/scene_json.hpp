// A scene as JSON: the tables and keys of the scene format, with overrides and all defaults.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Keys are those of the TOML format; automatic values are "auto". Keys of a [[joint]] that were not given, and
/// excluded keys (interval beside every), are omitted.
[[nodiscard]] nlohmann::ordered_json to_json(const Scene& scene);

/// The array of its blocks alone.
[[nodiscard]] nlohmann::ordered_json blocks_to_json(const std::vector<SceneBlock>& blocks);

}  // namespace ashlar
