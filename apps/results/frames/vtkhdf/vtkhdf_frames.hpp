// Frames in results.vtkhdf while it is written.
//
// A frame is appended to a second file, results.vtkhdf.next, which then changes names with the first. A process may
// end at any time: results.vtkhdf is complete and closed, with the last frame or with the one before. The second file
// has one frame less, is brought up to date before the next one and removed at the end (notes/vtkhdf.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/results/frames/frame_files.hpp"
#include "apps/results/system/named_file.hpp"

namespace ashlar {

class VtkhdfFrames : public FrameFiles {
 public:
  /// Creates the file.
  VtkhdfFrames(const std::filesystem::path& folder, const std::vector<std::string>& series);
  /// Goes on with the file of an earlier run, whose later frames are removed.
  VtkhdfFrames(const std::filesystem::path& folder, std::vector<FrameTime> frames);
  ~VtkhdfFrames() override;

  void add(const FrameTime& frame, std::vector<SeriesGrid> grids, const std::vector<std::string>& block_names,
           const std::function<void()>& check) override;
  void check_in_place() const override;
  [[nodiscard]] const std::vector<FrameTime>& frames() const override { return frames_; }

 private:
  void exchange_names();
  void remember_file();

  std::filesystem::path folder_;
  std::filesystem::path file_;
  std::filesystem::path next_;
  std::vector<FrameTime> frames_;
  NamedFile known_;       ///< file_ after the last frame
  bool follows_ = false;  ///< next_ exists and has one frame less than file_
};

/// Removes the files, in any state.
void remove_vtkhdf_files(const std::filesystem::path& folder);

}  // namespace ashlar
