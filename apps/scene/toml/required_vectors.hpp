// Vectors that a table must have: points, corners, normals.
#pragma once

#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// A vector that is required: not finite if it is missing or faulty, so that no later check applies to it.
[[nodiscard]] Vector3 required_vector(TomlTableReader& table, const char* key);
/// The same for coordinates, m.
[[nodiscard]] Vector3 required_place(TomlTableReader& table, const char* key);
/// A direction of any length but zero.
[[nodiscard]] Vector3 required_direction(TomlTableReader& table, const char* key);

}  // namespace ashlar
