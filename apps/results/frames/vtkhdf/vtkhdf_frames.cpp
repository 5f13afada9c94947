#include "apps/results/frames/vtkhdf/vtkhdf_frames.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>
#include <utility>

#include "apps/results/system/output_file.hpp"

namespace ashlar {
namespace {

constexpr const char* next_name = "results.vtkhdf.next";
constexpr const char* between_name = "results.vtkhdf.old";  ///< of the first file while names change

}  // namespace

void remove_vtkhdf_files(const std::filesystem::path& folder) {
  for (const char* name : {vtkhdf_name, next_name, between_name}) std::filesystem::remove(folder / name);
}

VtkhdfFrames::VtkhdfFrames(const std::filesystem::path& folder, const std::vector<std::string>& series)
    : folder_(folder), file_(folder / vtkhdf_name), next_(folder / next_name) {
  create_vtkhdf(next_, series);
  rename_over(next_, file_);
  remember_file();
}

VtkhdfFrames::VtkhdfFrames(const std::filesystem::path& folder, std::vector<FrameTime> frames)
    : folder_(folder), file_(folder / vtkhdf_name), next_(folder / next_name), frames_(std::move(frames)) {
  std::filesystem::remove(folder / between_name);
  std::filesystem::remove(next_);
  std::filesystem::copy_file(file_, next_);
  cut_vtkhdf(next_, frames_.size());
  rename_over(next_, file_);
  remember_file();
}

VtkhdfFrames::~VtkhdfFrames() {
  std::error_code error;
  if (follows_) std::filesystem::remove(next_, error);
}

void VtkhdfFrames::add(const FrameTime& frame, std::vector<SeriesGrid> grids,
                       const std::vector<std::string>& block_names, const std::function<void()>& check) {
  try {
    if (std::exchange(follows_, false)) {
      append_frames_of(file_, next_);
    } else {
      std::filesystem::remove(next_);
      std::filesystem::copy_file(file_, next_);
    }
    append_vtkhdf(next_, frame, grids, block_names);
    check();
    exchange_names();
  } catch (...) {
    std::error_code error;
    std::filesystem::remove(next_, error);
    throw;
  }
  frames_.push_back(frame);
  remember_file();
}

void VtkhdfFrames::exchange_names() {
  const std::filesystem::path between = folder_ / between_name;
  std::error_code error;
  std::filesystem::remove(between, error);
  // File systems without a second name for a file: the next frame copies the whole file.
  std::filesystem::create_hard_link(file_, between, error);
  rename_over(next_, file_);
  if (error) return;
  std::filesystem::rename(between, next_, error);
  follows_ = !error;
}

void VtkhdfFrames::remember_file() {
  known_ = named_file(file_);
}

void VtkhdfFrames::check_in_place() const {
  const NamedFile now = named_file(file_);
  if (!now.is_same_as(known_) || !now.is_plain || now.bytes != known_.bytes)
    throw std::runtime_error(
        fmt::format("{} was replaced or changed by others while it was being written", file_.string()));
}

}  // namespace ashlar
