// The frames of a result folder in either format, read back.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "apps/results/frames/vtkhdf/vtkhdf_file.hpp"

namespace ashlar {

/// Functions throw std::runtime_error "cannot read PATH: REASON".
class StoredFrames {
 public:
  StoredFrames() = default;
  virtual ~StoredFrames() = default;
  StoredFrames(const StoredFrames&) = delete;
  StoredFrames& operator=(const StoredFrames&) = delete;

  /// True if the run wrote the series; it may have no frames yet.
  [[nodiscard]] virtual bool has(const std::string& series) const = 0;
  /// Frames of a series. A run in progress has written some series first.
  [[nodiscard]] virtual std::size_t count(const std::string& series) const = 0;
  /// @param series one that the run wrote
  [[nodiscard]] virtual FrameTime time(const std::string& series, std::size_t frame) const = 0;
  [[nodiscard]] virtual UnstructuredGrid read(const std::string& series, std::size_t frame) const = 0;
  /// The file that has a frame, for messages.
  [[nodiscard]] virtual std::filesystem::path file(const std::string& series, std::size_t frame) const = 0;
};

/// True if the folder has frames of a run.
[[nodiscard]] bool has_stored_frames(const std::filesystem::path& folder);

/// @param folder one with stored frames
[[nodiscard]] std::unique_ptr<StoredFrames> open_stored_frames(const std::filesystem::path& folder);

}  // namespace ashlar
