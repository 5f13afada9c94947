// A folder outside of which this process reads no input: for programs that read scenes of somebody else, whose includes,
// meshes and records may name any file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ashlar {

/// From here on input files are read only below one of the folders, links followed, by all threads and later copies of
/// this process. Called before there are other threads. @param folders none: no limit
/// @throws std::filesystem::filesystem_error if one of them does not exist
void limit_reading_to(const std::vector<std::filesystem::path>& folders);

/// True if a file or folder is the folder or lies below it, links followed, whether it exists or not.
/// @param folder of std::filesystem::canonical()
[[nodiscard]] bool is_below(const std::filesystem::path& file, const std::filesystem::path& folder);

/// Empty if the file may be read; otherwise "outside of the folder /models, only files below it are read". Of several
/// folders the first is named.
[[nodiscard]] std::string refusal_to_read(const std::filesystem::path& file);
/// @throws std::runtime_error "it is " and the refusal, if there is one
void require_readable(const std::filesystem::path& file);

}  // namespace ashlar
