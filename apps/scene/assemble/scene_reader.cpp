#include "apps/scene/assemble/scene_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>

#include "apps/scene/expand/scene_expansion.hpp"
#include "apps/scene/keys/scene_keys.hpp"
#include "apps/scene/masonry/masonry.hpp"
#include "apps/scene/model/model_position.hpp"
#include "apps/scene/read/assignments.hpp"
#include "apps/scene/read/formulation_reader.hpp"
#include "apps/scene/read/model_origin.hpp"
#include "apps/scene/toml/fault_text.hpp"
#include "apps/scene/toml/include.hpp"
#include "apps/scene/toml/input_file.hpp"
#include "apps/scene/toml/parameters.hpp"
#include "apps/scene/toml/scene_overrides.hpp"
#include "apps/scene/toml/toml_faults.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"
#include "geometry/text/reading_folder.hpp"

namespace ashlar {
namespace {

/// @param block a SceneBlock or a SceneAssign
template <class Block>
bool has_history(const Block& block) {
  return std::any_of(block.fix.begin(), block.fix.end(),
                     [](const SceneFix& fix) { return !fix.history.empty(); }) ||
         std::any_of(block.load.begin(), block.load.end(),
                     [](const SceneLoad& load) { return !load.history.empty(); });
}

/// Reports a key that `analysis` does not have, of the scene or of a stage.
/// @param table that has `analysis`
void require_in_analysis(TomlTableReader& table, const char* key) {
  const toml::table* given = table.table_at("analysis");
  if (given == nullptr || !given->contains(key)) table.empty_table("analysis").require(key);
}

/// A static analysis of constant loads does not need times.
/// @param table that has `analysis`. @param loads_change true if anything but gravity does
void complete_times(TomlTableReader& table, SceneAnalysis& analysis, bool loads_change) {
  const bool timeless = is_static(analysis) && analysis.gravity_history.empty() && !loads_change;
  if (!timeless) {
    // A stage inherits [analysis].
    if (!(analysis.end_time > 0.0)) require_in_analysis(table, "end_time");
    if (analysis.accuracy && !is_static(analysis) && !(analysis.time_step > 0.0)) {
      analysis.automatic_step = true;
      analysis.time_step = analysis.end_time / automatic_steps;
    } else if (!(analysis.time_step > 0.0) && !analysis.automatic_step) {
      require_in_analysis(table, "time_step");
    }
    return;
  }
  if (!(analysis.end_time > 0.0)) analysis.end_time = std::max(default_static_end_time, analysis.time_step);
  analysis.automatic_step = false;
  if (!(analysis.time_step > 0.0)) analysis.time_step = std::min(default_static_time_step, analysis.end_time);
}

/// @param base replaced key by key by the stage's `analysis`
SceneStage read_stage(TomlTableReader& table, const SceneAnalysis& base) {
  SceneStage stage;
  stage.analysis = base;
  keys::stage_keys().read(table, stage);
  const bool loads_change =
      std::any_of(stage.fix.begin(), stage.fix.end(),
                  [](const SceneStage::Fix& entry) { return !entry.fix.history.empty(); }) ||
      std::any_of(stage.load.begin(), stage.load.end(),
                  [](const SceneStage::Load& entry) { return !entry.load.history.empty(); });
  complete_times(table, stage.analysis, loads_change);
  return stage;
}

/// Without analysis.accuracy, blocks whose order is not given have order 1.
void keep_given_orders(Scene& scene) {
  if (scene.analysis.accuracy) return;
  for (std::size_t k = 0; k < scene.block.size(); ++k)
    if (!scene.places.contains(fmt::format("block.{}.order", k))) scene.block[k].automatic_order = false;
}

void read_tables(TomlTableReader top, Scene& scene) {
  keys::top_keys().read(top, scene);
  (void)top.given("parameters");  // read before all others
  keys::analysis_keys().read_table(top, "analysis", scene.analysis);
  keys::contact_keys().read_table(top, "contact", scene.contact);
  scene.joint = keys::joint_keys().read_all(top, "joint");
  scene.material = keys::material_keys().read_all(top, "material");
  scene.block = keys::block_keys().read_all(top, "block");
  std::vector<std::vector<SceneBlock>> masonry = top.read_tables("masonry", read_masonry);
  scene.assign = keys::assign_keys().read_all(top, "assign");
  scene.cut = keys::cut_keys().read_all(top, "cut");
  scene.bolt = keys::bolt_keys().read_all(top, "bolt");
  scene.prop = keys::prop_keys().read_all(top, "prop");
  scene.load = keys::moving_load_keys().read_all(top, "load");
  scene.measure = keys::measure_keys().read_all(top, "measure");
  scene.water = keys::water_keys().read_all(top, "water");
  keys::initial_stress_keys().read_table(top, "initial_stress", scene.initial_stress);
  scene.boundary = keys::boundary_keys().read_all(top, "boundary");
  scene.crack = keys::cracking_keys().read_all(top, "crack");
  keys::output_keys().read_table(top, "output", scene.output);
  if (!scene.output.every && !scene.output.interval) scene.output.every = default_frame_distance;
  if (top.given("include"))
    top.error_at_key("include", "include cannot be set (include), files are read before anything is set");
  const bool has_blocks = !scene.block.empty() || !masonry.empty();
  scene.stage =
      top.read_tables("stage", [&](TomlTableReader& table) { return read_stage(table, scene.analysis); });
  // Masonry is made near the origin of the model.
  move_to_model(scene);
  expand_blocks(scene, std::move(masonry), top.reading().diagnostics());
  if (scene.stage.empty())
    complete_times(
        top, scene.analysis,
        !scene.load.empty() || std::any_of(scene.block.begin(), scene.block.end(), has_history<SceneBlock>) ||
            std::any_of(scene.assign.begin(), scene.assign.end(),
                        [](const SceneAssign& later) { return later.inside && has_history(later); }));
  else
    scene.analysis = scene.stage.front().analysis;
  imply_contact(scene, top.reading().diagnostics());
  keep_given_orders(scene);
  if (!has_blocks) top.error_at_table("no block (0), at least one [[block]] is needed");
}

}  // namespace

Scene parse_scene(std::string_view text, const std::filesystem::path& file,
                  const std::vector<std::string>& overrides, Diagnostics& diagnostics) {
  Scene scene;
  scene.file = file;
  const Place start{file.string(), 1, 1};
  scene.places.record("", {start, start});
  try {
    auto [document, files] = parse_document(text, start.origin, diagnostics);
    apply_overrides(document, overrides, diagnostics);
    scene.origin = origin_of_model(document, files);
    TomlReading reading(std::move(files), diagnostics, scene.places);
    reading.set_formulas(read_parameters(document, reading));
    reading.set_origin(scene.origin);
    read_tables(TomlTableReader(reading, document, "", ""), scene);
    reading.report_unknown_keys();
  } catch (const toml::parse_error& error) {
    const toml::source_position& position = error.source().begin;
    diagnostics.error({start.origin, static_cast<int>(position.line), static_cast<int>(position.column)},
                      malformed_toml(text, error));
  }
  return scene;
}

/// Text of a scene file, which may be a pipe. @throws std::runtime_error with the reason alone
static std::string scene_text(const std::filesystem::path& file) {
  require_readable(file);
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) throw std::runtime_error("is a folder");
  // Some devices are unbounded.
  if (std::filesystem::is_character_file(file, ignored)) throw std::runtime_error("is a device");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(std::strerror(errno));
  const std::uintmax_t size = std::filesystem::file_size(file, ignored);
  if (!ignored && size > most_input_bytes) throw std::runtime_error(too_large(size));
  return whole_stream(stream, most_input_bytes);
}

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 Diagnostics& diagnostics) {
  const bool from_input = file == "-";
  const std::filesystem::path name = from_input ? "(standard input)" : file;
  std::string text;
  try {
    text = from_input ? whole_stream(std::cin, most_input_bytes) : scene_text(file);
    if (from_input && text.empty()) throw std::runtime_error("standard input is empty or closed");
  } catch (const std::runtime_error& reason) {
    diagnostics.error({name.string(), 1, 1},
                      fmt::format("scene {}cannot be read ({}), a {} is needed", from_input ? "" : "file ",
                                  fault_text(reason), from_input ? "scene" : "readable TOML file"));
    if (from_input) return parse_scene("", name, overrides, diagnostics);
    Scene none;
    none.file = file;
    return none;
  }
  return parse_scene(text, name, overrides, diagnostics);
}

}  // namespace ashlar
