#include "apps/program/import/import_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <memory>
#include <ostream>

#include "apps/results/text/atomic_file.hpp"
#include "apps/scene/import/model_import.hpp"
#include "apps/scene/toml/fault_text.hpp"

namespace ashlar {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& file) {
  return fs::exists(fs::symlink_status(file));
}

/// Name of the scene of a model: of one of LMGC90 that of the folder around DATBOX.
fs::path default_scene(fs::path file) {
  if (!file.has_filename()) file = file.parent_path();
  fs::path name = file.filename().replace_extension();
  if (name == "BODIES" || name == "DATBOX" || name == "." || name == "..") {
    fs::path folder = fs::absolute(file).lexically_normal();
    if (!folder.has_filename()) folder = folder.parent_path();
    if (name == "BODIES") folder = folder.parent_path();
    if (folder.filename() == "DATBOX") folder = folder.parent_path();
    name = folder.filename();
  }
  return name += ".toml";
}

}  // namespace

int import_command(const ImportOptions& options, std::ostream& out, std::ostream& err) {
  const fs::path scene = options.out.value_or(default_scene(options.file));
  const fs::path blocks = fs::path(scene).replace_extension(".obj");
  try {
    if (scene.extension() != ".toml")
      throw std::invalid_argument(
          fmt::format("{} is no scene, a name with the ending .toml is needed", scene.string()));
    const ImportedScene imported = import_model(options.file, scene, options.fixed);
    for (const fs::path& file : {scene, blocks}) {
      if (options.force || !is_there(file) || (file == blocks && imported.blocks.empty())) continue;
      throw std::invalid_argument(
          fmt::format("{} exists; choose another name by --out, or --force to replace files", file.string()));
    }
    if (!imported.blocks.empty()) write_file_atomically(blocks, imported.blocks, Durability::process);
    write_file_atomically(scene, imported.scene, Durability::process);
    for (const std::string& part : imported.left_out) err << "ashlar: left out: " << part << '\n';
    for (const std::string& note : imported.notes) err << "ashlar: note: " << note << '\n';
    out << "scene: " << scene.string() << '\n';
    if (!imported.blocks.empty()) out << fmt::format("blocks: {} in {}\n", imported.count, blocks.string());
    out << fmt::format("next: ashlar check '{}'\n", scene.string());
    return exit_status::done;
  } catch (const ImportError& error) {
    err << to_string(Diagnostic{error.place(), error.what()}) << '\n';
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    err << "ashlar: error: " << fault_text(error) << '\n';
    return exit_status::of(error);
  }
  return exit_status::bad_input;
}

void declare_import_command(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand(
      "import",
      "Write a scene for the model of another program: COMPAS, LMGC90, 3DEC, UnBlocks, or a mesh of blocks");
  // Shared with the callback that reads it.
  const auto options = std::make_shared<ImportOptions>();
  command
      ->add_option(
          "FILE", options->file,
          "COMPAS JSON, 3DEC (.dat, .3ddat), LMGC90 (folder or BODIES.DAT), UnBlocks (.dda), OBJ, MSH, ...")
      ->required()
      ->type_name("");
  command->add_option("-o,--out", options->out, "Scene to write (default: the name of FILE, in this folder)")
      ->type_name("SCENE");
  command
      ->add_option(
          "--fixed", options->fixed,
          "Names or globs of blocks that never move, besides those that the model holds: 0,17 or 'r1_*'")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAMES");
  command->add_flag("-f,--force", options->force, "Replace the scene and its OBJ file");
  command->callback(
      [&context, options] { context.status = import_command(*options, context.out, context.err); });
}

}  // namespace ashlar
