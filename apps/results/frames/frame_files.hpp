// Files of the frames of a run, while it is written: .vtu and .pvd files, or results.vtkhdf.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/results/frames/vtkhdf/vtkhdf_file.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// All functions throw std::runtime_error with path and reason if a file cannot be written.
class FrameFiles {
 public:
  FrameFiles() = default;
  virtual ~FrameFiles() = default;
  FrameFiles(const FrameFiles&) = delete;
  FrameFiles& operator=(const FrameFiles&) = delete;

  /// Adds a frame to all series. A failed call adds none.
  /// @param grids of all series. @param check called before files are replaced, when their bytes are ready
  virtual void add(const FrameTime& frame, std::vector<SeriesGrid> grids,
                   const std::vector<std::string>& block_names, const std::function<void()>& check) = 0;
  /// @throws if a file or folder no longer exists, or was replaced by another one
  virtual void check_in_place() const = 0;
  [[nodiscard]] virtual const std::vector<FrameTime>& frames() const = 0;
};

/// Files without frames in a folder from which remove_frame_files has removed all others.
[[nodiscard]] std::unique_ptr<FrameFiles> new_frame_files(const std::filesystem::path& folder,
                                                          SceneOutput::Format format,
                                                          const std::vector<std::string>& series);

/// The files of an earlier run with its first frames; later ones are removed.
[[nodiscard]] std::unique_ptr<FrameFiles> resumed_frame_files(const std::filesystem::path& folder,
                                                              SceneOutput::Format format,
                                                              const std::vector<std::string>& series,
                                                              std::vector<FrameTime> frames);

/// Removes the files of frames of either format, in any state.
void remove_frame_files(const std::filesystem::path& folder);

inline constexpr const char* vtkhdf_name = "results.vtkhdf";

}  // namespace ashlar
