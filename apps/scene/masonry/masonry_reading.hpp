// Functions shared by the readers of all kinds of masonry.
#pragma once

#include <optional>
#include <string_view>

#include "apps/scene/model/scene.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// Reads a required key. @return true if it is present and valid
[[nodiscard]] bool read_length(TomlTableReader& table, std::string_view key, double& length);

/// The same for an optional key.
[[nodiscard]] bool read_optional_length(TomlTableReader& table, std::string_view key, double& length);

/// Reads the optional position of masonry. @param position in the user's coordinates, its default; becomes relative to
/// the origin of the model
[[nodiscard]] bool read_masonry_position(TomlTableReader& table, std::string_view key, Vector3& position);

/// Reads a required number of pieces, at least `low`.
[[nodiscard]] bool read_count(TomlTableReader& table, std::string_view key, int& count, int low);

/// Counts pieces of masonry, and reports, at the masonry, if all so far exceed the limit of a scene.
/// @return true if they do not
[[nodiscard]] bool check_pieces(TomlTableReader& table, double pieces);

/// Reads the key `direction`, default x: the rotation about the vertical through `about` that maps x to it; empty for
/// x. Refuses a direction that is not horizontal, or zero.
/// @return true if the key is absent or valid
[[nodiscard]] bool read_direction(TomlTableReader& table, const Vector3& about,
                                  std::optional<SceneRotation>& turn);

}  // namespace ashlar
