// A file that one process at a time can lock. The system releases the lock with the process in any case.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace ashlar {

/// Functions return the system's reason for a failure, or none.
class LockFile {
 public:
  enum class Start {
    existing,  ///< std::errc::no_such_file_or_directory if it does not exist
    created,   ///< std::errc::file_exists if it exists
  };

  LockFile() = default;
  ~LockFile();
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

  /// Opens it in place of an open one. Links are not followed, and a pipe does not block.
  [[nodiscard]] std::error_code open(const std::filesystem::path& path, Start start);
  void close();
  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }

  /// @return std::errc::resource_unavailable_try_again if another process has the lock; another reason on a file system
  /// without locks
  [[nodiscard]] std::error_code lock();

  /// False for a folder, a device and the like. @param bytes of a plain file
  [[nodiscard]] std::error_code find_kind(bool& plain, std::uint64_t& bytes) const;
  /// True if the path names this file, not another one or a link.
  [[nodiscard]] bool is_at(const std::filesystem::path& path) const;
  /// At most so many bytes from its start on.
  [[nodiscard]] std::string start(std::size_t bytes) const;
  /// Replaces all bytes.
  [[nodiscard]] std::error_code replace(std::string_view content);

 private:
  int descriptor_ = -1;
};

}  // namespace ashlar
