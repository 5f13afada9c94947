// Disk space reserved for the last files of a run. It is released when the disk is full, so that the state reached by
// a run can still be saved.
#pragma once

#include <cstdint>
#include <filesystem>

namespace ashlar {

/// A file without a name, which the system removes with the process in any case.
class SpaceReserve {
 public:
  /// @param folder on the file system of the reserved space; nothing is reserved yet
  explicit SpaceReserve(std::filesystem::path folder);
  ~SpaceReserve();
  SpaceReserve(const SpaceReserve&) = delete;
  SpaceReserve& operator=(const SpaceReserve&) = delete;

  /// Reserves at least this much. @throws std::system_error "cannot keep <bytes> bytes free in <folder>: ..."
  void hold(std::uintmax_t bytes);
  /// Releases all of it.
  void release() noexcept;

  [[nodiscard]] std::uintmax_t held() const { return held_; }

 private:
  [[noreturn]] void fail(std::uintmax_t bytes, int reason) const;

  std::filesystem::path folder_;
  int descriptor_ = -1;
  std::uintmax_t held_ = 0;  ///< bytes
};

}  // namespace ashlar
