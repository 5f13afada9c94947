#include "apps/program/check_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <utility>

#include "apps/program/run/override_option.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/run/run_setup.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/check/warnings/base_motion.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

/// Summary of a valid scene, a line each.
std::vector<std::string> notes_of(const Scene& scene) {
  std::vector<std::string> lines = scene.notes;
  for (std::string& line : motion_left(scene)) lines.push_back(std::move(line));
  return lines;
}

void print_report(const std::filesystem::path& file, const LoadedScene& loaded, std::ostream& out) {
  const Scene& scene = loaded.scene;
  const auto counted = [](std::size_t count, const char* noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
  };
  out << fmt::format("{}: good: {}, {}, {}, {}\n", file.string(), counted(scene.block.size(), "block"),
                     counted(scene.material.size(), "material"), counted(scene.joint.size(), "joint"),
                     counted(scene.measure.size(), "measure"));
  out << to_string(loaded.cost, scene.block.size()) << '\n';
  for (const std::string& line : notes_of(scene)) out << line << '\n';
}

Json fault_json(const Diagnostic& fault) {
  Json json{{"severity", fault.severity == Severity::error ? "error" : "warning"}};
  if (fault.place.line == 0) {
    json["argument"] = fault.place.origin;
  } else {
    json["file"] = fault.place.origin;
    json["line"] = fault.place.line;
    json["column"] = fault.place.column;
  }
  json["message"] = fault.message;
  return json;
}

/// @param loaded not null if there are no errors
Json report_json(const Diagnostics& diagnostics, const LoadedScene* loaded) {
  Json json{{"good", diagnostics.good()}, {"faults", Json::array()}};
  for (const Diagnostic& fault : diagnostics.listed()) json["faults"].push_back(fault_json(fault));
  if (!diagnostics.good()) return json;
  const Scene& scene = loaded->scene;
  json["blocks"] = scene.block.size();
  json["materials"] = scene.material.size();
  json["joints"] = scene.joint.size();
  json["measures"] = scene.measure.size();
  const CostEstimate& cost = loaded->cost;
  json["estimate"] = {{"sub_faces", cost.sub_faces},
                      {"unknowns", cost.unknowns},
                      {"near_pairs", cost.pairs},
                      {"memory_bytes", cost.memory}};
  json["notes"] = notes_of(scene);
  return json;
}

}  // namespace

int check_command(const CheckOptions& options, std::ostream& out, std::ostream& err) {
  Diagnostics diagnostics;
  std::shared_ptr<const LoadedScene> loaded;
  std::optional<BuiltSimulation> built;
  {
    Preparation preparation(false, err);
    if (auto scene = load_scene(options.scene, options.overrides, diagnostics, &preparation)) {
      loaded = std::make_shared<const LoadedScene>(std::move(*scene));
      built = build_first_stage(stage_scene(loaded, 0), 1, diagnostics, &preparation);
    }
  }
  if (options.json) {
    out << json_text(report_json(diagnostics, loaded.get()), 2) << '\n';
  } else {
    diagnostics.print(err);
    if (diagnostics.good()) print_report(options.scene, *loaded, out);
  }
  return diagnostics.good() ? exit_status::done : exit_status::bad_input;
}

void declare_check_command(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand("check", "Read and validate a scene; lists every error");
  // Shared with the callback that reads it.
  const auto options = std::make_shared<CheckOptions>();
  command->add_option("SCENE", options->scene, "Scene file (TOML); - is standard input")
      ->required()
      ->type_name("");
  declare_overrides(*command, options->overrides);
  command->add_flag("--json", options->json, "Print all output as JSON, faults with their places too");
  command->callback(
      [options, &context] { context.status = check_command(*options, context.out, context.err); });
}

}  // namespace ashlar
