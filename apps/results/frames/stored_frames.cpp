#include "apps/results/frames/stored_frames.hpp"

#include <charconv>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/results/frames/frame_files.hpp"
#include "apps/results/frames/vtu/vtu_reader.hpp"

namespace ashlar {
namespace {

/// "frames/blocks_0000950.vtu" is step 950.
int step_of(const std::string& file) {
  const std::size_t start = file.find_last_of('_');
  int step = 0;
  if (start != std::string::npos) std::from_chars(file.data() + start + 1, file.data() + file.size(), step);
  return step;
}

class StoredVtu : public StoredFrames {
 public:
  explicit StoredVtu(std::filesystem::path folder) : folder_(std::move(folder)) {
    for (const char* series : {"blocks", "surfaces", "contacts", "joints", "bolts", "loads"}) {
      const std::filesystem::path path = folder_ / (std::string(series) + ".pvd");
      const bool always = series == std::string_view("blocks") || series == std::string_view("contacts");
      if (always || std::filesystem::exists(path)) frames_[series] = read_pvd(path);
    }
  }

  [[nodiscard]] bool has(const std::string& series) const override { return frames_.contains(series); }
  [[nodiscard]] std::size_t count(const std::string& series) const override {
    return frames_.at(series).size();
  }
  [[nodiscard]] FrameTime time(const std::string& series, std::size_t frame) const override {
    const PvdFrame& of = frames_.at(series).at(frame);
    return {of.time, step_of(of.file)};
  }
  [[nodiscard]] UnstructuredGrid read(const std::string& series, std::size_t frame) const override {
    return read_vtu(file(series, frame));
  }
  [[nodiscard]] std::filesystem::path file(const std::string& series, std::size_t frame) const override {
    return folder_ / frames_.at(series).at(frame).file;
  }

 private:
  std::filesystem::path folder_;
  std::map<std::string, std::vector<PvdFrame>> frames_;
};

class StoredVtkhdf : public StoredFrames {
 public:
  explicit StoredVtkhdf(const std::filesystem::path& path) : path_(path), reader_(path) {}

  [[nodiscard]] bool has(const std::string& series) const override { return reader_.has(series); }
  [[nodiscard]] std::size_t count(const std::string& /*series*/) const override {
    return reader_.frames().size();
  }
  [[nodiscard]] FrameTime time(const std::string& /*series*/, std::size_t frame) const override {
    return reader_.frames().at(frame);
  }
  [[nodiscard]] UnstructuredGrid read(const std::string& series, std::size_t frame) const override {
    return reader_.read(series, frame);
  }
  [[nodiscard]] std::filesystem::path file(const std::string& /*series*/,
                                           std::size_t /*frame*/) const override {
    return path_;
  }

 private:
  std::filesystem::path path_;
  VtkhdfReader reader_;
};

}  // namespace

bool has_stored_frames(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "blocks.pvd") || std::filesystem::exists(folder / vtkhdf_name);
}

std::unique_ptr<StoredFrames> open_stored_frames(const std::filesystem::path& folder) {
  if (std::filesystem::exists(folder / "blocks.pvd")) return std::make_unique<StoredVtu>(folder);
  return std::make_unique<StoredVtkhdf>(folder / vtkhdf_name);
}

}  // namespace ashlar
