// Functions shared by the readers of all kinds of masonry.
#pragma once

#include <optional>

#include "apps/scene/model/scene.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// Counts pieces of masonry, and reports, at the masonry, if all so far exceed the limit of a scene.
/// @return true if they do not
[[nodiscard]] bool check_pieces(TomlTableReader& table, double pieces);

/// The rotation about the vertical through `about` that maps x to a level direction; empty for x.
[[nodiscard]] std::optional<SceneRotation> turn_to(const Vector3& direction, const Vector3& about);

}  // namespace ashlar
