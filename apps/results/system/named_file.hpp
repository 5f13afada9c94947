// Kind, size and identity of a file or folder by its name, of a link itself, not of its target; names in a folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace ashlar {

struct NamedFile {
  std::uint64_t device = 0;  ///< with `number` different for all files and folders that exist at a time
  std::uint64_t number = 0;
  std::uint64_t bytes = 0;  ///< of a plain file
  bool is_plain = false;    ///< neither folder nor link, pipe or the like
  bool is_folder = false;

  [[nodiscard]] bool is_same_as(const NamedFile& other) const {
    return device == other.device && number == other.number;
  }
};

/// @throws std::system_error "cannot find <path>: <reason>"
[[nodiscard]] NamedFile named_file(const std::filesystem::path& path);

/// Names of all that is in a folder, in no order. @throws std::system_error "cannot read folder <path>: <reason>"
[[nodiscard]] std::vector<std::filesystem::path> names_in(const std::filesystem::path& folder);

}  // namespace ashlar
