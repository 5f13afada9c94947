// Reads one [[boundary]] of a scene.
#pragma once

#include "apps/scene/model/scene.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// Faults go to the table's diagnostics; a plane that is missing or faulty is not finite.
[[nodiscard]] SceneBoundary read_boundary(TomlTableReader& table);

}  // namespace ashlar
