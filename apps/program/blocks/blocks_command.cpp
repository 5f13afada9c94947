#include "apps/program/blocks/blocks_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <ostream>

#include "apps/program/blocks/block_files.hpp"
#include "apps/program/blocks/block_histogram.hpp"
#include "apps/program/blocks/block_text.hpp"
#include "apps/program/blocks/mechanism_report.hpp"
#include "apps/program/number_option.hpp"
#include "apps/program/plot/plot_script.hpp"
#include "apps/program/run/override_option.hpp"
#include "apps/results/folder/folder_claim.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
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

/// "x=-8": the plane across an axis at a coordinate of the user.
std::optional<ScenePlane> read_border(const std::string& text, const Vector3& origin) {
  const std::size_t axis = text.empty() ? std::string::npos : std::string("xyz").find(text[0]);
  if (axis == std::string::npos || text.size() < 3 || text[1] != '=') return std::nullopt;
  const std::vector<double> number = numbers_of<double>(text.substr(2), ',');
  if (number.size() != 1 || !std::isfinite(number[0])) return std::nullopt;
  const Vector3 normal = Vector3::Unit(static_cast<Eigen::Index>(axis));
  return ScenePlane{(number[0] - origin.dot(normal)) * normal, normal};
}

/// Planes of --border. @return empty after a fault
std::optional<std::vector<ScenePlane>> read_borders(const std::vector<std::string>& texts,
                                                    const Vector3& origin, std::ostream& err) {
  std::vector<ScenePlane> planes;
  for (const std::string& text : texts) {
    const std::optional<ScenePlane> plane = read_border(text, origin);
    if (!plane) {
      err << fmt::format(
          "ashlar: error: --border is no plane across an axis ({}), x=, y= or z= and a coordinate are "
          "needed\n",
          text);
      return std::nullopt;
    }
    planes.push_back(*plane);
  }
  return planes;
}

/// Of a scene with --removable. @param status changed after a fault, which is told: there are none then
std::vector<KeyGroup> mechanisms_of(const BlocksOptions& options, const BlockReport& report,
                                    const RemovableSearch& search, std::ostream& err, int& status) {
  if (options.mechanisms == 0) return {};
  try {
    Preparation progress(false, err);
    return find_mechanisms(report.loaded(), search, options.mechanisms, progress);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    err << fmt::format("ashlar: error: no mechanisms by limit analysis: {}\n", error.what());
    status = exit_status::of(error);
    return {};
  }
}

std::filesystem::path folder_of(const BlocksOptions& options) {
  if (options.folder) return *options.folder;
  if (options.scene == "-") return "scene.blocks";
  return options.scene.stem().string() + ".blocks";
}

/// @return message to the user
std::string write_files(const std::filesystem::path& folder, const BlockReport& report,
                        const std::vector<RemovableBlock>& removable,
                        const std::vector<KeyGroup>& mechanisms) {
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
  std::string tables;
  if (!removable.empty()) {
    write_file_atomically(folder / "key_blocks.csv", removable_csv(report, removable), Durability::process);
    tables += fmt::format("key blocks: {}\n", (folder / "key_blocks.csv").string());
  }
  if (!mechanisms.empty()) {
    write_file_atomically(folder / "mechanisms.csv", mechanisms_csv(report, mechanisms), Durability::process);
    tables += fmt::format("mechanisms: {}\n", (folder / "mechanisms.csv").string());
  }
  return tables + fmt::format("blocks: {}\nmodel: {} (.stl, .msh)\n{}", (folder / "blocks.vtu").string(),
                              (folder / "blocks.obj").string(),
                              write_plot(sizes, folder / "sizes.svg", true));
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
  const auto borders = read_borders(options.borders, loaded->scene.origin, err);
  if (!borders) return exit_status::bad_input;
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
  std::vector<KeyGroup> mechanisms;
  int status = exit_status::done;
  if (force) {
    const RemovableSearch search{*force, options.wanted, *borders};
    removable = find_removable_blocks(report, search);
    mechanisms = mechanisms_of(options, report, search, err, status);
  }
  const std::vector<RemovableBlock>* looked_at = force ? &removable : nullptr;
  if (options.json) {
    auto json = report_json(report, looked_at);
    if (options.mechanisms > 0) json["mechanisms"] = mechanisms_json(report, mechanisms);
    out << json_text(json) << '\n';
  } else {
    out << report_text(report, looked_at);
    if (options.mechanisms > 0) out << mechanisms_text(report, mechanisms);
  }
  if (!claim) return status;
  const std::string written = write_files(claim->folder(), report, removable, mechanisms);
  (options.json ? err : out) << written;
  return status;
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
  CLI::Option* removable =
      command
          ->add_option("--removable", options->force,
                       "Key-block analysis of blocks with a free face, under a force of this direction")
          ->type_name("X,Y,Z");
  command
      ->add_option(
          "--border", options->borders,
          "A border of the model that is no free face, besides the planes of supports and boundaries "
          "(repeatable, with --removable)")
      ->type_name("x=X")
      ->needs(removable);
  command
      ->add_option(
          "--mechanisms", options->mechanisms,
          "With --removable: at most so many mechanisms by limit analysis, blocks and groups with bolts and "
          "all strengths of joints, each with its own factor")
      ->check(CLI::Range(0, 1000))
      ->type_name("N")
      ->needs(removable);
  command
      ->add_option("--wanted", options->wanted,
                   "With --removable: factor for which needed forces are told (default: 1)")
      ->check(CLI::PositiveNumber)
      ->type_name("F")
      ->needs(removable);
  command->add_option("--stage", options->stage, "Blocks that are there in this stage (default: all blocks)")
      ->type_name("NAME");
  declare_overrides(*command, options->overrides);
  command->callback(
      [options, &context] { context.status = blocks_command(*options, context.out, context.err); });
}

}  // namespace ashlar
