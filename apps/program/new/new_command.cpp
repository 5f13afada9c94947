#include "apps/program/new/new_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <memory>
#include <ostream>
#include <vector>

#include "apps/program/new/starting_scenes.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/assemble/scene_schema.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/toml/fault_text.hpp"

namespace ashlar {
namespace {

std::vector<std::string> scene_kinds() {
  std::vector<std::string> names;
  for (const StartingScene& scene : starting_scenes()) names.emplace_back(scene.kind);
  return names;
}

}  // namespace

int new_command(const NewOptions& options, std::ostream& out, std::ostream& err) {
  const auto scenes = starting_scenes();
  const auto found = std::find_if(scenes.begin(), scenes.end(),
                                  [&](const StartingScene& scene) { return scene.kind == options.kind; });
  if (found == scenes.end()) {
    err << fmt::format("ashlar: error: unknown kind of scene ({}), {}one of {} is needed\n", options.kind,
                       guess(options.kind, scene_kinds()), fmt::join(scene_kinds(), ", "));
    return exit_status::bad_input;
  }
  const std::filesystem::path file = options.file.value_or(options.kind + ".toml");
  const std::filesystem::path schema = file.parent_path() / "scene.schema.json";
  if (file == "-") {
    err << "ashlar: error: a scene is written to a file, not to standard output (-)\n";
    return exit_status::bad_input;
  }
  if (!options.force && std::filesystem::exists(std::filesystem::symlink_status(file))) {
    err << fmt::format("ashlar: error: {} exists; choose another name, or --force to replace a file\n",
                       file.string());
    return exit_status::bad_input;
  }
  try {
    write_file_of_kind(schema, json_text(scene_schema(), 2) + '\n',
                       {"schema of scenes", {R"("title": "Ashlar scene")"}});
    write_file_atomically(file, found->text, Durability::process);
  } catch (const std::exception& fault) {
    err << "ashlar: error: " << fault_text(fault) << '\n';
    return exit_status::of(fault);
  }
  out << fmt::format("scene: {}\nschema: {} (for editors)\nnext: ashlar run '{}' --view\n", file.string(),
                     schema.string(), (file.string().starts_with('-') ? "." / file : file).string());
  return exit_status::done;
}

void declare_new_command(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand(
      "new", fmt::format("Write a commented scene to begin with: {}", fmt::join(scene_kinds(), ", ")));
  // Shared with the callback that reads it.
  const auto options = std::make_shared<NewOptions>();
  command->add_option("KIND", options->kind, fmt::format("One of {}", fmt::join(scene_kinds(), ", ")))
      ->required()
      ->type_name("");
  command->add_option("FILE", options->file, "Scene to write (default: KIND.toml)")->type_name("");
  command->add_flag("-f,--force", options->force, "Replace the file");
  command->callback(
      [&context, options] { context.status = new_command(*options, context.out, context.err); });
}

}  // namespace ashlar
