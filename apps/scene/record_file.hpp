// Records (of an earthquake, of a load) from CSV files: a line of column names, then a line for each time. Files of
// other kinds are told by their first line (peer_record.hpp).
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"

namespace ashlar {

/// The rows [time, values...] of a record; values are scaled. Fields are separated by commas, semicolons or
/// tabs, whichever the line of names has; lines that are blank or begin with # are passed over. Faults are
/// reported at their line and column of the file, the first 20 and a count; a file that cannot be read, or
/// has more than most_input_bytes, at `place`.
/// @param folder that relative paths are relative to. @param place of the file's name in the scene
/// @return none if there is a fault
[[nodiscard]] std::optional<std::vector<std::vector<double>>> read_record(const SceneRecord& record,
                                                                          const std::filesystem::path& folder,
                                                                          const Place& place,
                                                                          Diagnostics& diagnostics);

/// The same of what is in a file. @param name of the file, for messages
[[nodiscard]] std::optional<std::vector<std::vector<double>>> parse_record(const SceneRecord& record,
                                                                           std::istream& content,
                                                                           const std::string& name,
                                                                           Diagnostics& diagnostics);

}  // namespace ashlar
