// Replacement of a file as a whole: a reader at any time gets all of the old content or all of the new.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

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

/// Files of the same kind as one that a command writes under a name of the user's choice.
struct FileKind {
  const char* name;                     ///< "PNG picture"
  std::vector<std::string_view> marks;  ///< each file of the kind has one of them in its first 1000 bytes
};

/// Checks that a file may be replaced: it does not exist, is empty, or is of the kind.
/// @throws std::invalid_argument "PATH is in the way: it is no KIND, another name is needed"
void refuse_other_file(const std::filesystem::path& path, const FileKind& kind);

/// The functions for files outside of folders that belong to a run: as write_file_atomically, of files that may be replaced.
/// @throws std::invalid_argument as refuse_other_file
void write_file_of_kind(const std::filesystem::path& path, std::string_view content, const FileKind& kind);

[[nodiscard]] inline FileKind png_picture() {
  return {"PNG picture", {"\x89PNG"}};
}
[[nodiscard]] inline FileKind svg_picture() {
  return {"SVG picture", {"<svg"}};
}

}  // namespace ashlar
