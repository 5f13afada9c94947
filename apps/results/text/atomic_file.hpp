// Replacement of a file as a whole: a reader at any time gets all of the old content or all of the new.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string_view>

#include "apps/results/system/output_file.hpp"

namespace ashlar {

/// Events that the new content survives. Waiting for the disk costs milliseconds for each file.
enum class Durability {
  process,  ///< a crashed or killed process; for the many frames of a run
  power,    ///< a power failure too; for a checkpoint
};

/// Writes `content` to `path` + ".tmp" and renames that to `path`. Neither follows a link. A failure leaves `path`
/// untouched and no temporary file.
/// @param path its folder must exist.
/// @throws std::system_error (a std::runtime_error) with the path and the system's reason, also if `path` is
/// a folder, a device or a pipe
void write_file_atomically(const std::filesystem::path& path, std::string_view content,
                           Durability durability);

/// The same for content that is not in memory as a whole. @param write is called once with the open file
void write_file_atomically(const std::filesystem::path& path, Durability durability,
                           const std::function<void(OutputFile&)>& write);

/// Checks that a file may be replaced: it does not exist, or its first 1000 bytes have one of these marks of its
/// kind.
/// @throws std::invalid_argument "PATH is in the way: it is no KIND, another name is needed"
void refuse_other_file(const std::filesystem::path& path, const char* kind,
                       std::initializer_list<std::string_view> marks);

inline constexpr std::string_view png_mark = "\x89PNG", svg_mark = "<svg";

}  // namespace ashlar
