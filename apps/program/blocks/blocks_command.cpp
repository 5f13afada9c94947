#include "apps/program/blocks/blocks_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>
#include <ostream>

#include "apps/program/blocks/block_files.hpp"
#include "apps/program/blocks/block_histogram.hpp"
#include "apps/program/blocks/block_text.hpp"
#include "apps/program/number_option.hpp"
#include "apps/program/plot/plot_script.hpp"
#include "apps/program/run/override_option.hpp"
#include "apps/results/folder/folder_claim.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/build/scene_loading.hpp"
#include "apps/scene/model/nearest_name.hpp"

namespace ashlar {
namespace {

/// Three numbers with commas between, not all zero.
std::optional<Vector3> read_force(const std::string& text) {
  const std::vector<double> numbers = numbers_of<double>(text, ',');
  if (numbers.size() != 3) return std::nullopt;
  const Vector3 force(numbers[0], numbers[1], numbers[2]);
  return force.allFinite() && !force.isZero(0.0) ? std::optional(force) : std::nullopt;
}

std::filesystem::path folder_of(const BlocksOptions& options) {
  if (options.folder) return *options.folder;
  if (options.scene == "-") return "scene.blocks";
  return options.scene.stem().string() + ".blocks";
}

/// @return message to the user
std::string write_files(const std::filesystem::path& folder, const BlockReport& report,
                        const std::vector<RemovableBlock>& removable) {
  const LoadedScene& loaded = report.loaded();
  std::vector<double> volumes;
  for (std::size_t k = 0; k < report.blocks().size(); ++k)
    if (report.is_there(k)) volumes.push_back(report.blocks()[k].volume);
  const Plot sizes = size_plot(
      fmt::format("{}: {} blocks, {:.6g} m\u00b3", loaded.scene.title, volumes.size(), report.volume()),
      volumes);
  write_vtu(folder / "blocks.vtu", block_grid(report, removable));
  write_file_atomically(folder / "blocks.obj", block_obj(loaded), Durability::process);
  write_file_atomically(folder / "blocks.stl", block_stl(loaded), Durability::process);
  write_file_atomically(folder / "blocks.msh", block_msh(loaded), Durability::process);
  return fmt::format("blocks: {}\nmodel: {} (.stl, .msh)\n{}", (folder / "blocks.vtu").string(),
                     (folder / "blocks.obj").string(), write_plot(sizes, folder / "sizes.svg", true));
}

/// Replaces a scene by one of its stages. @return false after a fault
bool choose_stage(LoadedScene& loaded, const std::string& name, std::ostream& err) {
  std::vector<std::string> names;
  for (const SceneStage& stage : loaded.scene.stage) names.push_back(stage.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    err << fmt::format(
        "ashlar: error: no stage of that name (--stage {}), {}the name of a [[stage]] without faults is "
        "needed\n",
        name, guess(name, names, "\""));
    return false;
  }
  loaded = stage_of(loaded, static_cast<std::size_t>(found - names.begin()));
  const std::vector<bool>& absent = loaded.scene.absent;
  if (std::find(absent.begin(), absent.end(), false) != absent.end()) return true;
  err << fmt::format("ashlar: error: no block is there in stage \"{}\", one with a block is needed\n", name);
  return false;
}

}  // namespace

int blocks_command(const BlocksOptions& options, std::ostream& out, std::ostream& err) {
  std::optional<Vector3> force;
  if (options.force) {
    force = read_force(*options.force);
    if (!force) {
      err << fmt::format(
          "ashlar: error: --removable is not a direction ({}), three numbers x,y,z, not all zero, "
          "are needed\n",
          *options.force);
      return exit_status::bad_input;
    }
  }
  Diagnostics diagnostics;
  std::optional<LoadedScene> loaded;
  {
    Preparation preparation(false, err);
    loaded = load_scene(options.scene, options.overrides, diagnostics, &preparation, LoadPurpose::blocks);
  }
  diagnostics.print(err);
  if (!loaded) return exit_status::bad_input;
  if (options.stage && !choose_stage(*loaded, *options.stage, err)) return exit_status::bad_input;
  std::optional<FolderClaim> claim;
  if (options.folder || !options.json) {
    try {
      claim.emplace(folder_of(options), ClaimPurpose::addition);
    } catch (const ClaimRefused& refused) {
      err << "ashlar: error: " << refused.what() << '\n';
      return exit_status::bad_input;
    }
  }
  const BlockReport report(std::make_shared<const LoadedScene>(*std::move(loaded)));
  std::vector<RemovableBlock> removable;
  if (force) removable = find_removable_blocks(report, *force);
  const std::vector<RemovableBlock>* looked_at = force ? &removable : nullptr;
  if (options.json)
    out << json_text(report_json(report, looked_at)) << '\n';
  else
    out << report_text(report, looked_at);
  if (!claim) return exit_status::done;
  const std::string written = write_files(claim->folder(), report, removable);
  (options.json ? err : out) << written;
  return exit_status::done;
}

void declare_blocks_command(CLI::App& program, CommandContext& context) {
  CLI::App* command =
      program.add_subcommand("blocks", "The blocks of a scene: sizes, neighbours, key blocks; as files too");
  // Shared with the callback that reads it.
  const auto options = std::make_shared<BlocksOptions>();
  command->add_option("SCENE", options->scene, "Scene file (TOML); - is standard input")
      ->required()
      ->type_name("");
  command
      ->add_option(
          "-o,--out", options->folder,
          "Folder of blocks.vtu, .obj, .stl, .msh and the histogram (default: scene name + .blocks; with "
          "--json: none)")
      ->type_name("DIR");
  command->add_flag("--json", options->json, "Print JSON");
  command
      ->add_option("--removable", options->force,
                   "Key-block analysis of blocks with a free face, under a force of this direction")
      ->type_name("X,Y,Z");
  command->add_option("--stage", options->stage, "Blocks that are there in this stage (default: all blocks)")
      ->type_name("NAME");
  declare_overrides(*command, options->overrides);
  command->callback(
      [options, &context] { context.status = blocks_command(*options, context.out, context.err); });
}

}  // namespace ashlar
