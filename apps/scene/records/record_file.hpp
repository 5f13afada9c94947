// Records (of an earthquake, of a load) from text files: a line of column names, then a line for each time. A file
// whose first line has numbers alone has no names: its columns are named "1", "2", ..., the first has the times, and of
// two columns any other name stands for the second. Other kinds are recognised by their first line (peer_record.hpp)
// or by the ending of their name, .V2 and .smc (sampled_record.hpp).
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// The rows [time, values...] of a record, with scaled values. Fields are separated by commas, semicolons, tabs or
/// blanks, as in the first line. Blank lines and lines that begin with # are ignored. Faults are reported at their line and
/// column of the file, the first 20 and a count; a file that cannot be read, or has more than most_input_bytes, at
/// `place`.
/// @param folder of relative paths. @param place of the file's name in the scene
/// @return empty if there is a fault
[[nodiscard]] std::optional<std::vector<std::vector<double>>> read_record(const SceneRecord& record,
                                                                          const std::filesystem::path& folder,
                                                                          const Place& place,
                                                                          Diagnostics& diagnostics);

/// The same for the content of a file. @param name of the file, for messages
[[nodiscard]] std::optional<std::vector<std::vector<double>>> parse_record(const SceneRecord& record,
                                                                           std::istream& content,
                                                                           const std::string& name,
                                                                           Diagnostics& diagnostics);

}  // namespace ashlar
