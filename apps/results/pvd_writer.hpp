// The time series of a run for ParaView: a .pvd file that names the frames and their times.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ashlar {

struct PvdFrame {
  double time;       ///< s
  std::string file;  ///< relative to the folder of the .pvd file
};

/// Keeps a .pvd file complete: it is replaced atomically after each frame, so a killed run leaves one that
/// ParaView opens with all frames written until then.
class PvdWriter {
 public:
  /// Writes the collection at once. @param frames those that a resumed run keeps.
  /// @throws std::runtime_error with path and reason, here and in add_frame.
  explicit PvdWriter(std::filesystem::path path, std::vector<PvdFrame> frames = {});

  /// To be called when the frame's own file is complete. Times are expected to increase. What fails adds
  /// none.
  void add_frame(double time, std::string file);
  /// Forgets the last frame; the file names it until it is written again.
  void drop_last() { frames_.pop_back(); }

  [[nodiscard]] const std::vector<PvdFrame>& frames() const { return frames_; }

 private:
  void write() const;

  std::filesystem::path path_;
  std::vector<PvdFrame> frames_;
};

}  // namespace ashlar
