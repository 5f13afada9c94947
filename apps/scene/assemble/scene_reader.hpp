// From TOML text to a Scene: keys, types, ranges and words of every table. Checks that involve several tables, or
// geometry, are in scene_checks.hpp.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Reads a scene from its text. Reading continues after faults, except malformed TOML, whose first fault is reported:
/// the parser cannot continue.
/// @param file name of the text for messages and folder of its paths; it is not opened.
/// @param overrides see scene_overrides.hpp.
/// @return the parts that could be read; only for further checks if diagnostics grew.
[[nodiscard]] Scene parse_scene(std::string_view text, const std::filesystem::path& file,
                                const std::vector<std::string>& overrides, Diagnostics& diagnostics);

/// Reads a scene file, as parse_scene. A file that cannot be read is reported at its line 1, column 1.
[[nodiscard]] Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                               Diagnostics& diagnostics);

}  // namespace ashlar
