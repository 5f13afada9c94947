// Disk space that is kept for what a run writes last. When the disk is full it is given back, so that the
// state that a run has reached can still be saved.
#pragma once

#include <cstdint>
#include <filesystem>

namespace ashlar {

/// A file without a name, which the system removes with the process, however that ends.
class SpaceReserve {
 public:
  /// @param folder on the file system where the space is kept; nothing is kept yet
  explicit SpaceReserve(std::filesystem::path folder);
  ~SpaceReserve();
  SpaceReserve(const SpaceReserve&) = delete;
  SpaceReserve& operator=(const SpaceReserve&) = delete;

  /// Keeps at least this much. @throws std::system_error "cannot keep <bytes> bytes free in <folder>: ..."
  void hold(std::uintmax_t bytes);
  /// Gives all of it back.
  void release() noexcept;

  [[nodiscard]] std::uintmax_t held() const { return held_; }

 private:
  [[noreturn]] void fail(std::uintmax_t bytes, int reason) const;

  std::filesystem::path folder_;
  int descriptor_ = -1;
  std::uintmax_t held_ = 0;  ///< bytes
};

}  // namespace ashlar
