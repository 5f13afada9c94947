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

/// Keeps a .pvd file complete: it is replaced atomically after each frame, so that ParaView can open the file of a
/// killed run with all frames written before.
class PvdWriter {
 public:
  /// Writes the collection at once. @param frames kept by a resumed run.
  /// @throws std::runtime_error with path and reason, here and in add_frame.
  explicit PvdWriter(std::filesystem::path path, std::vector<PvdFrame> frames = {});

  /// To be called when the frame's own file is complete. Times must increase. A failed call adds no frame.
  void add_frame(double time, std::string file);
  /// Removes the last frame; the file names it until it is written again.
  void drop_last() { frames_.pop_back(); }

  [[nodiscard]] const std::vector<PvdFrame>& frames() const { return frames_; }

 private:
  void write() const;

  std::filesystem::path path_;
  std::vector<PvdFrame> frames_;
};

}  // namespace ashlar
