#include "apps/program/view/view_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/program/view/key_block_table.hpp"
#include "apps/program/view/packed_numbers.hpp"
#include "apps/program/view/view_assets.hpp"
#include "apps/program/view/view_frames.hpp"
#include "apps/results/tables/history_table.hpp"
#include "apps/results/tables/thinned_series.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

// A plot is some thousand pixels wide at most.
constexpr std::size_t most_history_rows = 2000;

/// Null if there is none.
Json json_file(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return nullptr;
  return naming_the_file(path, [&] { return parse_json(whole_file(path)); });
}

/// The table column by column as floats, of at most most_history_rows rows.
Json history_json(const std::filesystem::path& folder) {
  const HistoryTable table = read_history(folder / "history.csv", most_history_rows);
  PackedNumbers numbers;
  for (std::size_t column = 0; column < table.columns.size(); ++column)
    for (const auto& row : table.rows) numbers.add_float(row[column]);
  return {{"columns", table.columns},
          {"about", json_file(folder / "history.units.json")},
          {"rows", table.rows.size()},
          {"data", numbers.base64()}};
}

/// The type of the analysis; for a staged analysis "dynamic" if one of them is, otherwise that of the first. Null:
/// unknown.
Json analysis_of(const Json& scene) {
  const auto type_in = [](const Json& table) -> Json {
    if (!table.is_object() || !table.contains("analysis") || !table["analysis"].is_object()) return nullptr;
    return table["analysis"].value("type", Json());
  };
  if (!scene.contains("stage") || !scene["stage"].is_array() || scene["stage"].empty()) return type_in(scene);
  for (const Json& stage : scene["stage"])
    if (type_in(stage) == "dynamic") return "dynamic";
  return type_in(scene["stage"].front());
}

/// A text of a block, empty if there is none.
std::string text_of(const Json& block, const char* key) {
  const auto value = block.find(key);
  return value != block.end() && value->is_string() ? value->get<std::string>() : "";
}

/// The entries of a list of a table; none if there is no list.
std::vector<Json> list_in(const Json& table, const char* key) {
  std::vector<Json> entries;
  if (!table.is_object() || !table.contains(key) || !table[key].is_array()) return entries;
  for (const Json& entry : table[key]) entries.push_back(entry.is_object() ? entry : Json::object());
  return entries;
}

/// Plane levels of water: name, stage (0: from the start; the last one of a name that has begun counts), point, normal.
/// Levels from files have no plane.
/// @param origin of the page, m
Json water_levels(const Json& scene, const Vector3& origin) {
  Json levels = Json::array();
  const auto add = [&](const Json& table, std::size_t stage) {
    for (const Json& water : list_in(table, "water")) {
      const Json level = water.value("level", Json::object());
      Json entry = {
          {"name", text_of(water, "name")}, {"stage", stage}, {"point", nullptr}, {"normal", nullptr}};
      for (const char* key : {"point", "normal"})
        if (level.contains(key)) entry[key] = level[key];
      if (entry["point"].is_array() && entry["point"].size() == 3)
        for (int axis = 0; axis < 3; ++axis) {
          Json& coordinate = entry["point"][static_cast<std::size_t>(axis)];
          if (coordinate.is_number()) coordinate = coordinate.get<double>() - origin[axis];
        }
      levels.push_back(std::move(entry));
    }
  };
  add(scene, 0);
  const std::vector<Json> stages = list_in(scene, "stage");
  for (std::size_t k = 0; k < stages.size(); ++k) add(stages[k], k + 1);
  return levels;
}

/// Type of the analysis of a stage. @param otherwise if it gives none
Json analysis_type(const Json& stage, const Json& otherwise) {
  const auto analysis = stage.find("analysis");
  return analysis != stage.end() && analysis->is_object() ? analysis->value("type", otherwise) : otherwise;
}

/// Materials of the blocks of a scene by name. A piece NAME.3 of a cut block has that of NAME.
class Materials {
 public:
  explicit Materials(const std::vector<Json>& blocks) {
    for (const Json& block : blocks) known_[text_of(block, "name")] = text_of(block, "material");
  }
  [[nodiscard]] std::string of(std::string name) const {
    for (;;) {
      if (const auto found = known_.find(name); found != known_.end()) return found->second;
      const std::size_t dot = name.find_last_of('.');
      if (dot == std::string::npos) return "";
      name.resize(dot);
    }
  }

 private:
  std::map<std::string, std::string> known_;
};

/// Data of the scene for the page: the kind of analysis, names and materials of blocks. The scene itself may hold
/// long histories.
/// @param summary from which the scene is removed
/// @param names of the blocks of frames; empty: those of the scene
void move_scene(Json& summary, std::vector<std::string> names, const Vector3& origin, Json& page) {
  Json scene;
  if (summary.is_object() && summary.contains("scene")) {
    scene = std::move(summary["scene"]);
    summary.erase("scene");
  }
  page["analysis"] = scene.is_object() ? analysis_of(scene) : Json(nullptr);
  page["water"] = water_levels(scene, origin);
  page["stages"] = Json::array();
  for (const Json& stage : list_in(scene, "stage"))
    page["stages"].push_back(
        {{"name", text_of(stage, "name")}, {"analysis", analysis_type(stage, page["analysis"])}});
  const std::vector<Json> blocks = list_in(scene, "block");
  if (names.empty())
    for (const Json& block : blocks) names.push_back(text_of(block, "name"));
  const Materials materials(blocks);
  page["blocks"] = Json::array();
  for (const std::string& name : names)
    page["blocks"].push_back({{"name", name}, {"material", materials.of(name)}});
}

/// Number of the block of this name, or if there is none, of this number.
/// @throws std::invalid_argument if there is none
std::size_t number_called(const std::string& name, const Json& blocks) {
  std::vector<std::string> names;
  for (const Json& block : blocks) names.push_back(text_of(block, "name"));
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error == std::errc{} && end == name.data() + name.size() && number < names.size()) return number;
  throw std::invalid_argument(fmt::format(
      "the run has no block \"{}\" that displacements can be relative to; {}a block by name or number, "
      "or none is allowed",
      name, guess(name, names, "\"")));
}

/// Number of the block that displacements are relative to; null: none.
Json relative_to(const std::optional<std::string>& wanted, const Json& summary, const Json& blocks) {
  const auto is_called = [&](const std::string& name) {
    return std::any_of(blocks.begin(), blocks.end(),
                       [&](const Json& block) { return text_of(block, "name") == name; });
  };
  if (wanted) {
    if (*wanted == "none" && !is_called("none")) return nullptr;
    return number_called(*wanted, blocks);
  }
  const std::string base = summary.is_object() ? text_of(summary, "base") : "";
  return base.empty() || !is_called(base) ? Json(nullptr) : Json(number_called(base, blocks));
}

Json scene_json(const std::filesystem::path& folder, const ViewFrames& reader, const ViewOptions& options) {
  const ViewSurface& surface = reader.surface();
  PackedNumbers reference;
  for (const Vector3& point : surface.reference)
    for (int k = 0; k < 3; ++k) reference.add_float(point[k]);
  Json page = {{"name", std::filesystem::absolute(folder).lexically_normal().filename().string()},
               {"points", surface.reference.size()},
               {"origin", {reader.origin().x(), reader.origin().y(), reader.origin().z()}},
               {"reference", reference.base64()},
               {"cells", deflated_base64({reinterpret_cast<const char*>(surface.cells.data()),
                                          surface.cells.size() * sizeof(std::int32_t)})},
               {"fixed", surface.fixed},
               {"velocity", surface.velocity},
               {"stress", surface.stress},
               {"water_pressure", surface.water},
               {"fracture_energy", surface.fracture},
               {"few_points", most_few_points},
               {"history", history_json(folder)}};
  Json summary = json_file(folder / "summary.json");
  move_scene(summary, reader.block_names(), reader.origin(), page);
  page["relative_to"] = relative_to(options.relative_to, summary, page["blocks"]);
  page["summary"] = std::move(summary);
  page["key_blocks"] = read_key_blocks(folder);
  return page;
}

/// JSON that cannot end its script element, for any names in the scene.
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
    if (at == std::string_view::npos) throw std::logic_error("page.html has no line " + marker);
    text += page.substr(0, at);
    text += part;
    text += '\n';
    page.remove_prefix(at + marker.size());
  }
  text += page;
  return text;
}

/// Three.js and the other libraries, deflated, a line each in the order of execution.
std::string libraries_text(const ViewAssets& assets) {
  std::string text;
  for (const std::string_view library : assets.libraries) text += deflated_base64(library) + '\n';
  return text;
}

std::string frames_text(const std::vector<ThinnedSeries<ViewFrameData>::Item>& frames) {
  std::string text;
  for (const auto& frame : frames) text += frame.value.data + '\n';
  return text;
}

}  // namespace

ViewReport write_view_file(const std::filesystem::path& folder, const std::filesystem::path& page,
                           const ViewOptions& options) {
  const ViewFrames reader(folder, options.points);
  if (options.frame && *options.frame >= reader.count())
    throw std::out_of_range(
        fmt::format("no frame {}, the last one is {}", *options.frame, reader.count() - 1));
  Json scene = scene_json(folder, reader, options);
  const ViewAssets assets = view_assets();
  const std::string libraries = libraries_text(assets);
  const std::size_t fixed_bytes = assets.page.size() + assets.style.size() + assets.script.size() +
                                  libraries.size() + script_safe(scene).size();
  constexpr std::size_t head_bytes = 200;
  ThinnedSeries<ViewFrameData> frames(options.most_bytes - std::min(fixed_bytes, options.most_bytes),
                                      {reader.count() - 1, options.frame.value_or(0)});
  for (std::size_t index = 0; index < reader.count(); ++index) {
    if (!frames.wants(index)) continue;
    ViewFrameData frame = reader.read(index);
    const std::size_t cost = frame.data.size() + head_bytes;
    frames.add(index, std::move(frame), cost);
  }
  scene["frame_count"] = reader.count();
  scene["frames"] = Json::array();
  for (const auto& frame : frames.items()) scene["frames"].push_back(frame.value.head);

  const std::string frame_lines = frames_text(frames.items());
  const std::string scene_text = script_safe(scene);
  const std::vector<std::pair<std::string_view, std::string_view>> parts = {{"STYLE", assets.style},
                                                                            {"LIBRARIES", libraries},
                                                                            {"SCENE", scene_text},
                                                                            {"FRAMES", frame_lines},
                                                                            {"SCRIPT", assets.script}};
  const std::string text = assembled(assets.page, parts);
  write_file_of_kind(page, text, view_page());
  return {reader.count(), frames.items().size(), text.size()};
}

}  // namespace ashlar
