// An open output file whose every failure is an exception with the file's name and the system's reason.
// Streams report neither, and a result that is silently cut short is worse than a run that stops.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace ashlar {

/// Owns one POSIX descriptor. All functions throw std::system_error (a std::runtime_error) with
/// "cannot <what> <path>: <reason>", e.g. when the disk is full or permission is missing.
class OutputFile {
 public:
  enum class Start {
    created,  ///< must not exist
    empty,    ///< created, or emptied if it exists
    at_end,   ///< must exist; writing goes on after its last byte
  };

  /// Links are not followed, and pipes are refused: they would wait for a reader.
  OutputFile(std::filesystem::path path, Start start);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Hands all of `bytes` to the system at the current end. Nothing stays in this process, so they outlive
  /// it, whatever ends it. After a failure the file is cut back to its length before the call.
  void write(std::string_view bytes);
  /// Keeps the first `size` bytes only; writing goes on there.
  void truncate(std::uintmax_t size);
  /// Waits until everything written is on the disk.
  void sync();
  /// @throws if the path names this file no more (removed, moved, replaced), or others have cut it or added bytes
  void check_in_place() const;
  /// Closes and reports what closing finds (network file systems report a full disk here).
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

}  // namespace ashlar
