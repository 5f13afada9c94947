#include "apps/view/view_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/results/atomic_file.hpp"
#include "apps/results/base64.hpp"
#include "apps/results/grid_arrays.hpp"
#include "apps/results/history_table.hpp"
#include "apps/results/input_file.hpp"
#include "apps/results/json_text.hpp"
#include "apps/results/thinned_series.hpp"
#include "apps/results/vtu_reader.hpp"
#include "apps/view/block_union.hpp"
#include "apps/view/curved_cells.hpp"
#include "apps/view/view_assets.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

// A plot is some thousand pixels wide at most.
constexpr std::size_t most_history_rows = 2000;

template <class T>
std::string base64_of(const std::vector<T>& values) {
  return to_base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

void append_floats(std::vector<float>& floats, const std::vector<double>& values) {
  for (const double value : values) floats.push_back(static_cast<float>(value));
}

/// What does not change from frame to frame.
struct Surface {
  std::vector<Vector3> reference;   ///< places less displacements, m
  std::vector<std::int32_t> cells;  ///< block, order, face, number of corners, corners; cell after cell
  bool velocity = false;
  bool stress = false;
};

Surface surface_of(const UnstructuredGrid& grid) {
  Surface surface;
  surface.reference = grid.points;
  if (const auto* values = find_values<double>(grid.point_data, "displacement", 3)) {
    for (std::size_t i = 0; i < grid.points.size(); ++i)
      surface.reference[i] -= Vector3((*values)[3 * i], (*values)[3 * i + 1], (*values)[3 * i + 2]);
  }
  const auto& block = required_values<std::int32_t>(grid.cell_data, "block", 1);
  const auto& order = required_values<std::int32_t>(grid.cell_data, "order", 1);
  const auto& face = required_values<std::int32_t>(grid.cell_data, "face", 1);
  int start = 0;
  for (std::size_t c = 0; c < grid.offsets.size(); ++c) {
    const int end = grid.offsets[c];
    surface.cells.insert(surface.cells.end(), {block[c], order[c], face[c], end - start});
    surface.cells.insert(surface.cells.end(), grid.connectivity.begin() + start,
                         grid.connectivity.begin() + end);
    start = end;
  }
  surface.velocity = find_values<double>(grid.point_data, "velocity", 3) != nullptr;
  surface.stress = find_values<double>(grid.point_data, "stress", 6) != nullptr;
  return surface;
}

/// Displacements from the reference, then velocities and stresses if the run has them.
void append_blocks(std::vector<float>& floats, const UnstructuredGrid& grid, const Surface& surface) {
  if (grid.points.size() != surface.reference.size())
    throw std::runtime_error("the frames have different numbers of points");
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    const Vector3 displacement = grid.points[i] - surface.reference[i];
    for (int k = 0; k < 3; ++k) floats.push_back(static_cast<float>(displacement[k]));
  }
  if (surface.velocity) append_floats(floats, required_values<double>(grid.point_data, "velocity", 3));
  if (surface.stress) append_floats(floats, required_values<double>(grid.point_data, "stress", 6));
}

/// Place, force, normal, gap, area, type, state and both blocks of each contact: 15 numbers.
void append_contacts(std::vector<float>& floats, const UnstructuredGrid& grid) {
  const auto& data = grid.point_data;
  const std::array vectors = {&required_values<double>(data, "force", 3),
                              &required_values<double>(data, "normal", 3)};
  const std::array scalars = {&required_values<double>(data, "gap", 1),
                              &required_values<double>(data, "area", 1)};
  const std::array numbers = {
      &required_values<std::int32_t>(data, "type", 1), &required_values<std::int32_t>(data, "state", 1),
      &required_values<std::int32_t>(data, "block_a", 1), &required_values<std::int32_t>(data, "block_b", 1)};
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    for (int k = 0; k < 3; ++k) floats.push_back(static_cast<float>(grid.points[i][k]));
    for (const auto* values : vectors) {
      for (std::size_t k = 0; k < 3; ++k) floats.push_back(static_cast<float>((*values)[3 * i + k]));
    }
    for (const auto* values : scalars) floats.push_back(static_cast<float>((*values)[i]));
    for (const auto* values : numbers) floats.push_back(static_cast<float>((*values)[i]));
  }
}

/// "frames/blocks_0000950.vtu" is step 950.
int step_of(const std::string& file) {
  const std::size_t start = file.find_last_of('_');
  int step = 0;
  if (start != std::string::npos) std::from_chars(file.data() + start + 1, file.data() + file.size(), step);
  return step;
}

struct ViewFrame {
  Json head;         ///< index, step, time, number of contacts
  std::string data;  ///< base64 of append_blocks and append_contacts
};

/// The folder, if there are results in it.
const std::filesystem::path& checked_folder(const std::filesystem::path& folder) {
  constexpr const char* needed =
      "the folder that `ashlar run SCENE` wrote is needed (SCENE.out, or that of --out)";
  if (!std::filesystem::is_directory(folder)) {
    throw std::runtime_error(fmt::format("no result folder ({} {}), {}", folder.string(),
                                         std::filesystem::exists(folder) ? "is a file" : "does not exist",
                                         needed));
  }
  if (!std::filesystem::exists(folder / "blocks.pvd"))
    throw std::runtime_error(
        fmt::format("no results in {} (blocks.pvd does not exist), {}", folder.string(), needed));
  return folder;
}

/// Frames of a run with output.solid have volumes, and the surfaces of blocks beside them.
const char* surface_series(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "surfaces.pvd") ? "surfaces.pvd" : "blocks.pvd";
}

/// Whether blocks may come and go.
bool has_stages(const std::filesystem::path& folder) {
  const std::vector<std::string> columns = read_history(folder / "history.csv", 1).columns;
  return std::find(columns.begin(), columns.end(), "stage") != columns.end();
}

class FrameReader {
 public:
  explicit FrameReader(const std::filesystem::path& folder)
      : folder_(checked_folder(folder)),
        blocks_(read_pvd(folder / surface_series(folder))),
        contacts_(read_pvd(folder / "contacts.pvd")) {
    // A run that goes on has written one of the two first.
    count_ = std::min(blocks_.size(), contacts_.size());
    if (count_ == 0) throw std::runtime_error(fmt::format("{} has no frames", folder.string()));
    const std::filesystem::path path = folder_ / blocks_.front().file;
    UnstructuredGrid first = read_vtu(path);
    if (has_stages(folder)) {
      for (std::size_t k = 0; k < count_; ++k) {
        const std::filesystem::path frame = folder_ / blocks_[k].file;
        const UnstructuredGrid grid = read_vtu(frame);
        naming_the_file(frame, [&] { all_blocks_.add(grid); });
      }
      first = all_blocks_.whole();
    }
    naming_the_file(path, [&] {
      curved_ = std::make_unique<CurvedCells>(first);
      surface_ = surface_of(curved_->divided(std::move(first)));
    });
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const Surface& surface() const { return surface_; }

  [[nodiscard]] ViewFrame read(std::size_t index) const {
    const std::filesystem::path of_blocks = folder_ / blocks_[index].file;
    const std::filesystem::path of_contacts = folder_ / contacts_[index].file;
    std::vector<float> floats;
    UnstructuredGrid blocks = read_vtu(of_blocks);
    naming_the_file(of_blocks, [&] {
      append_blocks(floats, curved_->divided(all_blocks_.completed(std::move(blocks))), surface_);
    });
    const UnstructuredGrid contacts = read_vtu(of_contacts);
    naming_the_file(of_contacts, [&] { append_contacts(floats, contacts); });
    Json head = {{"index", index},
                 {"step", step_of(blocks_[index].file)},
                 {"time", blocks_[index].time},
                 {"contacts", contacts.points.size()}};
    return {std::move(head), base64_of(floats)};
  }

 private:
  std::filesystem::path folder_;
  std::vector<PvdFrame> blocks_;
  std::vector<PvdFrame> contacts_;
  std::size_t count_ = 0;
  BlockUnion all_blocks_;  ///< empty unless blocks come and go
  std::unique_ptr<const CurvedCells> curved_;
  Surface surface_;
};

Json history_json(const std::filesystem::path& folder) {
  const HistoryTable table = read_history(folder / "history.csv", most_history_rows);
  std::vector<float> floats;
  for (const auto& row : table.rows) append_floats(floats, row);
  return {{"columns", table.columns}, {"data", base64_of(floats)}};
}

Json summary_json(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "summary.json";
  if (!std::filesystem::exists(path)) return nullptr;
  return naming_the_file(path, [&] { return parse_json(whole_file(path)); });
}

Json scene_json(const std::filesystem::path& folder, const Surface& surface) {
  std::vector<float> reference;
  for (const Vector3& point : surface.reference) {
    for (int k = 0; k < 3; ++k) reference.push_back(static_cast<float>(point[k]));
  }
  return {{"name", std::filesystem::absolute(folder).lexically_normal().filename().string()},
          {"points", surface.reference.size()},
          {"reference", base64_of(reference)},
          {"cells", base64_of(surface.cells)},
          {"velocity", surface.velocity},
          {"stress", surface.stress},
          {"history", history_json(folder)},
          {"summary", summary_json(folder)}};
}

/// JSON that cannot end the script element it stands in, whatever a name in the scene contains.
std::string script_safe(const Json& json) {
  std::string safe;
  for (const char c : json_text(json)) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

/// The page with each line @NAME@ replaced by a part.
std::string assembled(std::string_view page,
                      const std::vector<std::pair<std::string_view, std::string_view>>& parts) {
  std::string text;
  for (const auto& [name, part] : parts) {
    const std::string marker = fmt::format("@{}@\n", name);
    const std::size_t at = page.find(marker);
    if (at == std::string_view::npos) throw std::logic_error("view_page.html has no line " + marker);
    text += page.substr(0, at);
    text += part;
    text += '\n';
    page.remove_prefix(at + marker.size());
  }
  text += page;
  return text;
}

/// In the order of the page; the scene and the frames are still empty.
std::vector<std::pair<std::string_view, std::string_view>> parts_of_page(const ViewAssets& assets) {
  return {{"STYLE", assets.style},
          {"THREE", assets.three},
          {"ORBIT_CONTROLS", assets.orbit_controls},
          {"CHART", assets.chart},
          {"SCENE", {}},
          {"FRAMES", {}},
          {"SCRIPT_DATA", assets.script_data},
          {"SCRIPT_SCENE", assets.script_scene},
          {"SCRIPT_PANELS", assets.script_panels},
          {"SCRIPT_PAGE", assets.script_page}};
}

std::string frames_text(const std::vector<ThinnedSeries<ViewFrame>::Item>& frames) {
  std::string text;
  for (const auto& frame : frames) text += frame.value.data + '\n';
  return text;
}

}  // namespace

ViewReport write_view_file(const std::filesystem::path& folder, const std::filesystem::path& page,
                           const ViewOptions& options) {
  const FrameReader reader(folder);
  if (options.frame && *options.frame >= reader.count())
    throw std::out_of_range(
        fmt::format("no frame {}, the last one is {}", *options.frame, reader.count() - 1));
  Json scene = scene_json(folder, reader.surface());
  const ViewAssets assets = view_assets();
  std::vector<std::pair<std::string_view, std::string_view>> parts = parts_of_page(assets);
  std::size_t fixed_bytes = assets.page.size() + script_safe(scene).size();
  for (const auto& [name, part] : parts) fixed_bytes += part.size();
  constexpr std::size_t head_bytes = 100;
  ThinnedSeries<ViewFrame> frames(options.most_bytes - std::min(fixed_bytes, options.most_bytes),
                                  {reader.count() - 1, options.frame.value_or(0)});
  for (std::size_t index = 0; index < reader.count(); ++index) {
    if (!frames.wants(index)) continue;
    ViewFrame frame = reader.read(index);
    const std::size_t cost = frame.data.size() + head_bytes;
    frames.add(index, std::move(frame), cost);
  }
  scene["frame_count"] = reader.count();
  scene["frames"] = Json::array();
  for (const auto& frame : frames.items()) scene["frames"].push_back(frame.value.head);

  const std::string frame_lines = frames_text(frames.items());
  const std::string scene_text = script_safe(scene);
  for (auto& [name, part] : parts) {
    if (name == "SCENE") part = scene_text;
    if (name == "FRAMES") part = frame_lines;
  }
  const std::string text = assembled(assets.page, parts);
  write_file_atomically(page, text, Durability::process);
  return {reader.count(), frames.items().size(), text.size()};
}

}  // namespace ashlar
