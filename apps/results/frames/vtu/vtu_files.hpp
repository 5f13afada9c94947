// Frames as .vtu files in the folder `frames` and a .pvd file for each series.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/results/folder/folder_watch.hpp"
#include "apps/results/frames/frame_files.hpp"
#include "apps/results/frames/vtu/pvd_writer.hpp"

namespace ashlar {

class VtuFiles : public FrameFiles {
 public:
  /// The folder `frames` must exist. Files of other frames are removed.
  VtuFiles(const std::filesystem::path& folder, const std::vector<std::string>& series,
           std::vector<FrameTime> frames);

  void add(const FrameTime& frame, std::vector<SeriesGrid> grids, const std::vector<std::string>& block_names,
           const std::function<void()>& check) override;
  void check_in_place() const override { watch_.check(); }
  [[nodiscard]] const std::vector<FrameTime>& frames() const override { return frames_; }

 private:
  std::filesystem::path folder_;
  FolderWatch watch_;
  std::vector<std::string> series_;
  std::vector<PvdWriter> collections_;  ///< by series
  std::vector<FrameTime> frames_;
};

/// "frames/blocks_0000010.vtu"
[[nodiscard]] std::string frame_file(const std::string& series, int step);

/// Removes files of frames from the folder `frames`, if there is one, but for some.
void remove_vtu_files_but(const std::filesystem::path& folder,
                          const std::vector<std::filesystem::path>& kept);

}  // namespace ashlar
