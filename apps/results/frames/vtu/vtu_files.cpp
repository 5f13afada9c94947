#include "apps/results/frames/vtu/vtu_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "apps/results/system/named_file.hpp"
#include "apps/results/text/atomic_file.hpp"

namespace ashlar {
namespace {

/// "blocks_0000010.vtu" and the like, or an incomplete one of a killed run
bool is_frame_name(std::string_view name) {
  for (const std::string_view start : {"blocks_", "surfaces_", "contacts_", "joints_", "bolts_", "loads_"}) {
    if (!name.starts_with(start)) continue;
    const std::string_view rest = name.substr(start.size());
    const std::size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
    return digits >= 7 && (rest.substr(digits) == ".vtu" || rest.substr(digits) == ".vtu.tmp");
  }
  return false;
}

std::vector<PvdFrame> collection_of(const std::string& series, const std::vector<FrameTime>& frames) {
  std::vector<PvdFrame> files;
  for (const FrameTime& frame : frames) files.push_back({frame.time, frame_file(series, frame.step)});
  return files;
}

}  // namespace

std::string frame_file(const std::string& series, int step) {
  return fmt::format("frames/{}_{:07}.vtu", series, step);
}

void remove_vtu_files_but(const std::filesystem::path& folder,
                          const std::vector<std::filesystem::path>& kept) {
  const std::filesystem::path frames = folder / "frames";
  if (!std::filesystem::is_directory(frames)) return;
  const std::set<std::filesystem::path> needed(kept.begin(), kept.end());
  for (const std::filesystem::path& name : names_in(frames)) {
    const std::filesystem::path file = frames / name;
    if (is_frame_name(name.string()) && !needed.contains(file) && named_file(file).is_plain)
      std::filesystem::remove(file);
  }
}

VtuFiles::VtuFiles(const std::filesystem::path& folder, const std::vector<std::string>& series,
                   std::vector<FrameTime> frames)
    : folder_(folder), watch_(folder / "frames"), series_(series), frames_(std::move(frames)) {
  std::vector<std::filesystem::path> kept;
  for (const std::string& name : series_) {
    collections_.emplace_back(folder_ / (name + ".pvd"), collection_of(name, frames_));
    for (const FrameTime& frame : frames_) kept.push_back(folder_ / frame_file(name, frame.step));
  }
  remove_vtu_files_but(folder_, kept);
}

void VtuFiles::add(const FrameTime& frame, std::vector<SeriesGrid> grids,
                   const std::vector<std::string>& block_names, const std::function<void()>& check) {
  for (SeriesGrid& of : grids) {
    of.grid.time = frame.time;
    of.grid.block_names = block_names;
    const std::string bytes = to_vtu(of.grid);
    check();
    write_file_atomically(folder_ / frame_file(of.series, frame.step), bytes, Durability::process);
  }
  // After a failure none of them remains.
  std::vector<PvdWriter*> added;
  try {
    for (std::size_t k = 0; k < series_.size(); ++k) {
      check();
      collections_[k].add_frame(frame.time, frame_file(series_[k], frame.step));
      added.push_back(&collections_[k]);
    }
  } catch (...) {
    for (PvdWriter* to : added) to->drop_last();
    throw;
  }
  frames_.push_back(frame);
}

}  // namespace ashlar
