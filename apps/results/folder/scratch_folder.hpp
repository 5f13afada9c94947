// A folder for temporary files.
#pragma once

#include <filesystem>
#include <new>
#include <system_error>

#include "apps/results/system/this_process.hpp"

namespace ashlar {

/// A new folder, readable by its owner only, among the system's temporary ones. Removed with this object.
class ScratchFolder {
 public:
  /// @throws std::system_error if it cannot be created
  ScratchFolder()
      : path_(new_private_folder(
            std::filesystem::absolute(std::filesystem::temp_directory_path() / "ashlar-"))) {}
  ~ScratchFolder() {
    std::error_code ignored;
    try {
      std::filesystem::remove_all(path_, ignored);
    } catch (
        const std::
            bad_alloc&) {  // NOLINT(bugprone-empty-catch): it then stays until the system is started again
    }
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace ashlar
