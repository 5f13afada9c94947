// The table of key blocks of a result folder, as `ashlar blocks SCENE -o FOLDER --removable X,Y,Z` adds it to those of a
// run.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace ashlar {

/// Rows of key_blocks.csv as objects by column: texts, numbers, null for values that are not finite. No rows if the
/// folder has no such file.
/// @throws std::runtime_error with path and line if it cannot be read
[[nodiscard]] nlohmann::ordered_json read_key_blocks(const std::filesystem::path& folder);

}  // namespace ashlar
