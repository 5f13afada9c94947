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
#include "apps/scene/masonry/masonry.hpp"
#include "apps/scene/model/model_position.hpp"
#include "apps/scene/model/scene_names.hpp"
#include "apps/scene/read/assignments.hpp"
#include "apps/scene/read/block_reader.hpp"
#include "apps/scene/read/bolt_reader.hpp"
#include "apps/scene/read/boundary_reader.hpp"
#include "apps/scene/read/cut_reader.hpp"
#include "apps/scene/read/formulation_reader.hpp"
#include "apps/scene/read/history_reader.hpp"
#include "apps/scene/read/initial_stress_reader.hpp"
#include "apps/scene/read/joint_reader.hpp"
#include "apps/scene/read/measure_reader.hpp"
#include "apps/scene/read/model_origin.hpp"
#include "apps/scene/read/moving_load_reader.hpp"
#include "apps/scene/read/pushover_reader.hpp"
#include "apps/scene/read/region_reader.hpp"
#include "apps/scene/read/water_reader.hpp"
#include "apps/scene/toml/fault_text.hpp"
#include "apps/scene/toml/include.hpp"
#include "apps/scene/toml/input_file.hpp"
#include "apps/scene/toml/parameters.hpp"
#include "apps/scene/toml/scene_overrides.hpp"
#include "apps/scene/toml/toml_faults.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {
namespace {

void read_factor_search(TomlTableReader table, const char* of, SceneAnalysis::FactorSearch& search) {
  if (table.read_texts(of, search.of) && search.of.empty())
    table.error_at_value(of, fmt::format("{} is empty (0 entries), names or globs are needed", of));
  table.read_number("tolerance", search.tolerance, range::positive_to_one);
  table.read_number("lower", search.lower, range::positive);
  table.read_number("upper", search.upper, range::positive);
  if (!(search.lower < search.upper))
    table.error_at_key("upper", fmt::format("upper is not above lower ({}), more than {} is needed",
                                            search.upper, search.lower));
}

void read_support_search(TomlTableReader table, SceneAnalysis::SupportSearch& search) {
  table.read_texts("supports", search.supports);
  Vector3 direction;
  if (table.read_vector("direction", direction)) {
    search.direction = direction;
    if (!(direction.norm() > 0.0))
      table.error_at_value("direction", "direction is zero ([0, 0, 0]), a vector of any length is needed");
  }
  table.read_number_or_auto("limit", search.limit, range::positive);
  table.read_number_or_auto("tolerance", search.tolerance, range::positive);
}

void read_time_step(TomlTableReader& table, SceneAnalysis& analysis) {
  std::optional<double> step;
  if (!table.read_number_or_auto("time_step", step, range::positive)) return;
  analysis.automatic_step = !step;
  analysis.time_step = step.value_or(0.0);
}

void read_analysis(TomlTableReader& table, SceneAnalysis& analysis) {
  table.read_choice("type", analysis.type, analysis_type_names);
  table.read_number("end_time", analysis.end_time, range::positive);
  read_time_step(table, analysis);
  table.read_number("accuracy", analysis.accuracy, range::positive_to_one);
  table.read_number("allowed_displacement", analysis.allowed_displacement, range::positive);
  table.read_choice("integrator", analysis.integrator, integrator_names);
  table.read_number("spectral_radius", analysis.spectral_radius, range::zero_to_one);
  read_formulation(table, analysis);
  table.read_choice("initial_state", analysis.initial_state, initial_state_names);
  // For a stage: one form of gravity replaces the other.
  if (table.read_vector("gravity", analysis.gravity)) analysis.gravity_history.clear();
  if (auto history = read_history(table, "gravity_history", 4, "[t, gx, gy, gz]")) {
    analysis.gravity_history.clear();
    analysis.gravity_file = std::move(history->file);
    for (const auto& row : history->rows)
      analysis.gravity_history.push_back({row[0], {row[1], row[2], row[3]}});
  }
  table.read_choice("solver", analysis.solver, solver_names);
  table.read_number("mass_damping", analysis.mass_damping, range::not_negative);
  table.read_number("stiffness_damping", analysis.stiffness_damping, range::not_negative);
  table.read_choice("method", analysis.method, method_names);
  read_factor_search(table.table_or_empty("safety"), "joints", analysis.safety);
  read_factor_search(table.table_or_empty("capacity"), "blocks", analysis.capacity);
  read_support_search(table.table_or_empty("movement"), analysis.movement);
  read_pushover(table, analysis);
  table.read_bool("sleeping", analysis.sleeping);
  table.read_number_or_auto("memory_limit", analysis.memory_limit, range::positive);
}

/// @param block a SceneBlock or a SceneAssign
template <class Block>
bool has_history(const Block& block) {
  return std::any_of(block.fix.begin(), block.fix.end(),
                     [](const SceneFix& fix) { return !fix.history.empty(); }) ||
         std::any_of(block.load.begin(), block.load.end(),
                     [](const SceneLoad& load) { return !load.history.empty(); });
}

/// A static analysis of constant loads does not need times. @param loads_change true if anything but gravity does
void complete_times(TomlTableReader& table, SceneAnalysis& analysis, bool loads_change) {
  const bool timeless = is_static(analysis) && analysis.gravity_history.empty() && !loads_change;
  if (!timeless) {
    // A stage inherits [analysis].
    if (!(analysis.end_time > 0.0)) table.require("end_time");
    if (analysis.accuracy && !is_static(analysis) && !(analysis.time_step > 0.0)) {
      analysis.automatic_step = true;
      analysis.time_step = analysis.end_time / automatic_steps;
    } else if (!(analysis.time_step > 0.0) && !analysis.automatic_step) {
      table.require("time_step");
    }
    return;
  }
  if (!(analysis.end_time > 0.0)) analysis.end_time = std::max(default_static_end_time, analysis.time_step);
  analysis.automatic_step = false;
  if (!(analysis.time_step > 0.0)) analysis.time_step = std::min(default_static_time_step, analysis.end_time);
}

SceneMaterial read_material(TomlTableReader& table) {
  SceneMaterial material;
  for (const char* key : {"name", "density", "young_modulus", "poisson_ratio"}) table.require(key);
  table.read_name("name", material.name);
  table.read_number("density", material.density, range::positive);
  table.read_number("young_modulus", material.young_modulus, range::positive);
  table.read_number("poisson_ratio", material.poisson_ratio, range::zero_to_below_half);
  table.read_choice("elasticity", material.elasticity, elasticity_names);
  return material;
}

void read_output(TomlTableReader table, SceneOutput& output) {
  const bool every_given = table.given("every"), interval_given = table.given("interval");
  table.read_integer("every", output.every, 1, std::numeric_limits<int>::max());
  table.read_number("interval", output.interval, range::positive);
  if (every_given && interval_given)
    table.error_at_key("interval", "interval beside every (both given), only one of both is allowed");
  if (!every_given && !interval_given) output.every = default_frame_distance;
  table.read_integer("history_every", output.history_every, 1, std::numeric_limits<int>::max());
  table.read_bool("curved", output.curved);
  table.read_bool("solid", output.solid);
  table.read_choice("format", output.format, frame_format_names);
  table.read_choice("precision", output.precision, precision_names);
  std::vector<std::string> fields;
  if (!table.read_words("fields", fields, field_names)) return;
  for (const auto& [name, member] : field_names)
    output.fields.*member = std::find(fields.begin(), fields.end(), name) != fields.end();
}

/// An entry of stages with the blocks that it is about.
template <class Entry, class Of>
Entry read_of_blocks(TomlTableReader& table, Of Entry::*member, Of (*read)(TomlTableReader&)) {
  Entry entry;
  read_blocks_or_inside(table, entry.blocks, entry.inside);
  entry.*member = read(table);
  return entry;
}

/// @param base replaced key by key by the stage's `analysis`
SceneStage read_stage(TomlTableReader& table, const SceneAnalysis& base) {
  SceneStage stage;
  table.require("name");
  table.read_name("name", stage.name);
  read_block_list(table, "remove", stage.remove, stage.remove_inside);
  read_block_list(table, "add", stage.add, stage.add_inside);
  stage.fix = table.read_tables(
      "fix", [](TomlTableReader& entry) { return read_of_blocks(entry, &SceneStage::Fix::fix, read_fix); });
  stage.load = table.read_tables("load", [](TomlTableReader& entry) {
    return read_of_blocks(entry, &SceneStage::Load::load, read_load);
  });
  stage.joint = table.read_tables("joint", read_joint);
  stage.material = table.read_tables("material", read_material);
  stage.water = table.read_tables("water", read_water);
  stage.bolt = table.read_tables("bolt", read_bolt);
  stage.prop = table.read_tables("prop", read_prop);
  table.read_texts("remove_support", stage.remove_support);
  table.read_bool("reset_displacement", stage.reset_displacement);
  stage.analysis = base;
  TomlTableReader analysis = table.table_or_empty("analysis");
  read_analysis(analysis, stage.analysis);
  const bool loads_change =
      std::any_of(stage.fix.begin(), stage.fix.end(),
                  [](const SceneStage::Fix& entry) { return !entry.fix.history.empty(); }) ||
      std::any_of(stage.load.begin(), stage.load.end(),
                  [](const SceneStage::Load& entry) { return !entry.load.history.empty(); });
  complete_times(analysis, stage.analysis, loads_change);
  return stage;
}

void read_tables(TomlTableReader top, Scene& scene) {
  top.read_text("title", scene.title);
  (void)top.given("parameters");  // read before all others
  TomlTableReader analysis = top.table_or_empty("analysis");
  read_analysis(analysis, scene.analysis);
  read_contact(top.table_or_empty("contact"), scene.contact);
  scene.joint = top.read_tables("joint", read_joint);
  scene.material = top.read_tables("material", read_material);
  scene.block = top.read_tables("block", read_block);
  std::vector<std::vector<SceneBlock>> masonry = top.read_tables("masonry", read_masonry);
  scene.assign = top.read_tables("assign", read_assignment);
  scene.cut = top.read_tables("cut", read_cut);
  scene.bolt = top.read_tables("bolt", read_bolt);
  scene.prop = top.read_tables("prop", read_prop);
  scene.load = top.read_tables("load", read_moving_load);
  scene.measure = top.read_tables("measure", read_measure);
  scene.water = top.read_tables("water", read_water);
  const bool stressed = top.given("initial_stress");
  TomlTableReader initial_stress = top.table_or_empty("initial_stress");
  scene.initial_stress = read_initial_stress(initial_stress, stressed);
  scene.boundary = top.read_tables("boundary", read_boundary);
  read_output(top.table_or_empty("output"), scene.output);
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
        analysis, scene.analysis,
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

void record_keys(std::string_view text, KeyRecorder& recorder) {
  Scene scene;
  Diagnostics ignored;
  auto [document, files] = parse_document(text, "schema", ignored);
  TomlReading reading(std::move(files), ignored, scene.places);
  reading.record_keys(recorder);
  read_tables(TomlTableReader(reading, document, "", ""), scene);
}

/// Text of a scene file, which may be a pipe. @throws std::runtime_error with the reason alone
static std::string scene_text(const std::filesystem::path& file) {
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
