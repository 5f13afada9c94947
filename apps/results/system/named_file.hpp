// Kind, size and identity of a file or folder by its name: of a link itself, not of its target.
#pragma once

#include <cstdint>
#include <filesystem>

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

}  // namespace ashlar
