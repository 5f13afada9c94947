// What the readers of all kinds of masonry need.
#pragma once

#include <optional>
#include <string_view>

#include "apps/scene/scene.hpp"
#include "apps/scene/toml_table_reader.hpp"

namespace ashlar {

/// A key that has to be there. @return whether it is, and good
[[nodiscard]] bool read_length(TomlTableReader& table, std::string_view key, double& length);

/// The same of a key that may be left out.
[[nodiscard]] bool read_optional_length(TomlTableReader& table, std::string_view key, double& length);

[[nodiscard]] bool read_optional_place(TomlTableReader& table, std::string_view key, Vector3& place);

/// A number of pieces that has to be given, from `low` on.
[[nodiscard]] bool read_count(TomlTableReader& table, std::string_view key, int& count, int low);

/// Counts pieces of masonry, and reports, at the masonry, where all so far are more than a scene may have.
/// @return whether they are not
[[nodiscard]] bool check_pieces(TomlTableReader& table, double pieces);

/// The key `direction`, x if left out: the turn about the vertical through `about` that brings x there, none
/// if it is x. Refused: a direction that is not level, or none.
/// @return whether the key is absent or good
[[nodiscard]] bool read_direction(TomlTableReader& table, const Vector3& about,
                                  std::optional<SceneRotation>& turn);

}  // namespace ashlar
