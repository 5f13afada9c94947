// From TOML text to a Scene: keys, types, ranges and words of every table. What needs more than one table, or
// geometry, is left to scene_checks.hpp.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/key_recorder.hpp"
#include "apps/scene/scene.hpp"

namespace ashlar {

/// Reads a scene from its text. Faults do not stop the reading, except malformed TOML, of which the first is
/// reported: the parser cannot go on.
/// @param file names the text in messages and gives the folder of its paths; it is not opened.
/// @param overrides see scene_overrides.hpp.
/// @return what could be read; only to be used for further checks if diagnostics grew.
[[nodiscard]] Scene parse_scene(std::string_view text, const std::filesystem::path& file,
                                const std::vector<std::string>& overrides, Diagnostics& diagnostics);

/// Reads a scene file, as parse_scene. A file that cannot be read is reported at its line 1, column 1.
[[nodiscard]] Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                               Diagnostics& diagnostics);

/// Reads a scene only to note what its tables are asked for; its faults do not matter.
void record_keys(std::string_view text, KeyRecorder& recorder);

}  // namespace ashlar
