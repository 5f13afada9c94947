#include "apps/results/frames/frame_files.hpp"

#include <stdexcept>
#include <system_error>
#include <utility>

#include "apps/results/frames/vtkhdf/vtkhdf_frames.hpp"
#include "apps/results/frames/vtu/vtu_files.hpp"

namespace ashlar {

void remove_frame_files(const std::filesystem::path& folder) {
  // Removed, not emptied: other names of these files keep their content.
  for (const char* series : {"blocks", "surfaces", "contacts", "joints", "bolts", "loads"})
    std::filesystem::remove(folder / (std::string(series) + ".pvd"));
  remove_vtu_files_but(folder, {});
  remove_vtkhdf_files(folder);
}

std::unique_ptr<FrameFiles> new_frame_files(const std::filesystem::path& folder, SceneOutput::Format format,
                                            const std::vector<std::string>& series) {
  std::error_code error;
  if (format == SceneOutput::Format::vtkhdf) {
    std::filesystem::remove(folder / "frames", error);  // of a run with .vtu files; only if it is empty
    return std::make_unique<VtkhdfFrames>(folder, series);
  }
  std::filesystem::create_directories(folder / "frames", error);
  if (error) throw std::system_error(error, "cannot create the folder " + (folder / "frames").string());
  return std::make_unique<VtuFiles>(folder, series, std::vector<FrameTime>());
}

std::unique_ptr<FrameFiles> resumed_frame_files(const std::filesystem::path& folder,
                                                SceneOutput::Format format,
                                                const std::vector<std::string>& series,
                                                std::vector<FrameTime> frames) {
  if (format == SceneOutput::Format::vtkhdf) return std::make_unique<VtkhdfFrames>(folder, std::move(frames));
  return std::make_unique<VtuFiles>(folder, series, std::move(frames));
}

}  // namespace ashlar
