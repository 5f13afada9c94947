// A scene as JSON: the tables and keys of the scene format, with overrides applied and every default filled
// in.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/scene/scene.hpp"

namespace ashlar {

/// Keys are those of the TOML format; what was left to the program reads "auto". Keys of a [[joint]] that
/// were not given are left out, and so are excluded ones (interval beside every).
[[nodiscard]] nlohmann::ordered_json to_json(const Scene& scene);

/// The array of its blocks alone.
[[nodiscard]] nlohmann::ordered_json blocks_to_json(const std::vector<SceneBlock>& blocks);

}  // namespace ashlar
