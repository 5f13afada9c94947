// An open output file whose failures are exceptions with the file's name and the system's reason. Streams provide
// neither, and a silently truncated result is worse than an aborted run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace ashlar {

/// Owns an open file of the system. All functions throw std::system_error (a std::runtime_error) with
/// "cannot <what> <path>: <reason>", e.g. when the disk is full or permission is missing.
class OutputFile {
 public:
  enum class Start {
    created,  ///< must not exist
    empty,    ///< created, or emptied if it exists
    at_end,   ///< must exist; writing starts after its last byte
  };

  /// Links are not followed, and pipes are refused, as they would wait for a reader.
  OutputFile(std::filesystem::path path, Start start);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Passes all of `bytes` to the system at the current end. Nothing is buffered in this process, so that they
  /// survive its end. After a failure the file is truncated to its length before the call.
  void write(std::string_view bytes);
  /// Keeps only the first `size` bytes; writing continues there.
  void truncate(std::uintmax_t size);
  /// Waits until all data are on the disk.
  void sync();
  /// @throws if the path no longer names this file (removed, moved, replaced), or others have truncated it or added
  /// bytes
  void check_in_place() const;
  /// Closes the file and reports errors found in closing (network file systems report a full disk here).
  void close();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Bytes in the file.
  [[nodiscard]] std::uintmax_t size() const { return size_; }

 private:
  [[noreturn]] void fail(const char* action) const;

  std::filesystem::path path_;
  int descriptor_ = -1;  ///< -1 after close() or a move
  std::uintmax_t size_ = 0;
};

/// True if the device or the process has no room left or fails: a full disk, a quota, too many open files. False for what
/// a user may have asked wrongly: names, permissions.
[[nodiscard]] bool is_fault_of_device(const std::error_code& reason);

/// Gives a file another name, in place of a file that has it. Where the system refuses that while another program has the
/// file open (Windows), it is tried again for two seconds. @throws std::filesystem::filesystem_error
void rename_over(const std::filesystem::path& from, const std::filesystem::path& to);

/// Waits until the names in a folder are on the disk; empty: the present one. No effect on file systems that cannot.
/// @throws std::system_error "cannot write folder <folder>: <reason>"
void sync_folder(const std::filesystem::path& folder);

}  // namespace ashlar
