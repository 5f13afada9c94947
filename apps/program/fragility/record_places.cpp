#include "apps/program/fragility/record_places.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <optional>

#include "apps/results/text/csv_text.hpp"
#include "apps/scene/import/model_scene.hpp"

namespace ashlar {
namespace {

constexpr const char* key_of_records = "acceleration_history";

Place place_of(const toml::node& node, const std::filesystem::path& scene) {
  const toml::source_region& source = node.source();
  return {source.path ? *source.path : scene.string(), static_cast<int>(source.begin.line),
          static_cast<int>(source.begin.column)};
}

/// Calls `take` with each value of the key, and its path.
void find_histories(const toml::node& node, const std::string& path,
                    const std::function<void(const toml::node&, const std::string&)>& take) {
  const auto below = [&](const toml::node& next, const std::string& name) {
    find_histories(next, path.empty() ? name : path + "." + name, take);
  };
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table)
      if (key.str() == key_of_records)
        take(value, path + "." + key_of_records);
      else
        below(value, std::string(key.str()));
  } else if (const toml::array* array = node.as_array()) {
    for (std::size_t k = 0; k < array->size(); ++k) below(*array->get(k), std::to_string(k));
  }
}

std::string scale_in(const toml::table& history) {
  const toml::node* scale = history.get("scale");
  if (scale == nullptr) return "1";
  if (const auto text = scale->value<std::string>()) return *text;
  return fmt::format("{}", scale->value<double>().value_or(std::nan("")));
}

/// The value of `scale` times a factor, as TOML.
std::string scaled(const std::string& scale, double factor) {
  if (scale == "g") return factor == 1.0 ? "\"g\"" : fmt::format("{}", factor * standard_gravity);
  if (scale.starts_with('=')) return quoted(fmt::format("= ({})*{}", scale.substr(1), factor));
  return factor == 1.0 ? scale : fmt::format("{}", csv_number(scale).value_or(1.0) * factor);
}

}  // namespace

std::vector<std::string> RecordPlaces::overrides(const std::filesystem::path& file, double factor) const {
  std::vector<std::string> result;
  for (const Table& table : tables) {
    result.push_back(fmt::format("{}.file={}", table.path, quoted(file.string())));
    result.push_back(fmt::format("{}.scale={}", table.path, scaled(table.scale, factor)));
  }
  return result;
}

RecordPlaces record_places(const toml::table& document, const std::filesystem::path& scene,
                           Diagnostics& diagnostics) {
  RecordPlaces places;
  std::optional<std::string> file;
  std::optional<Place> of_rows;
  find_histories(document, "", [&](const toml::node& node, const std::string& path) {
    const toml::table* history = node.as_table();
    const std::string name = history == nullptr ? "" : (*history)["file"].value_or(std::string());
    if (name.empty()) {
      of_rows = place_of(node, scene);
      return;
    }
    if (file && *file != name)
      diagnostics.error(place_of(node, scene),
                        fmt::format("records differ (\"{}\" and \"{}\"), one record for all supports is "
                                    "needed, in whose place others are taken",
                                    *file, name));
    file = name;
    places.resampled = history->contains("resample");
    places.tables.push_back({path, scale_in(*history)});
  });
  constexpr const char* wanted =
      "acceleration_history = { file = \"RECORD\", values = [\"a\", \"\", \"\"], scale = \"g\" }, whose file "
      "records take the place of";
  if (places.tables.empty() && of_rows)
    diagnostics.error(*of_rows, fmt::format("rows of an acceleration in the scene cannot be replaced by "
                                            "records, {}, is needed",
                                            wanted));
  else if (places.tables.empty())
    diagnostics.error(
        {scene.string(), 1, 1},
        fmt::format("scene has no base that a record moves, a support with {}, is needed", wanted));
  return places;
}

const SceneFix* record_support(const Scene& scene) {
  const auto has_record = [](const SceneFix& fix) {
    return fix.file && fix.record == MotionRecord::acceleration && !fix.history.empty();
  };
  for (const SceneBlock& block : scene.block)
    for (const SceneFix& fix : block.fix)
      if (has_record(fix)) return &fix;
  for (const SceneStage& stage : scene.stage)
    for (const SceneStage::Fix& entry : stage.fix)
      if (has_record(entry.fix)) return &entry.fix;
  return nullptr;
}

}  // namespace ashlar
