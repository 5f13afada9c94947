#include "apps/check_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <ostream>

#include "apps/run/override_option.hpp"
#include "apps/scene/base_motion.hpp"
#include "apps/scene/build_simulation.hpp"
#include "apps/scene/loose_blocks.hpp"
#include "apps/scene/scene_loading.hpp"

namespace ashlar {

int check_command(const CheckOptions& options, std::ostream& out, std::ostream& err) {
  Diagnostics diagnostics;
  std::optional<LoadedScene> loaded, staged;
  const LoadedScene* first = nullptr;  // of its stages, or the whole
  std::optional<BuiltSimulation> built;
  {
    Preparation preparation(false, err);
    loaded = load_scene(options.scene, options.overrides, diagnostics, &preparation);
    if (loaded) first = loaded->scene.stage.empty() ? &*loaded : &staged.emplace(stage_of(*loaded, 0));
    if (first != nullptr) built = build_simulation(*first, 1, diagnostics, &preparation);
    if (built && is_static(first->scene.analysis))
      refuse_loose_blocks(first->scene, built->simulation, diagnostics);
  }
  diagnostics.print(err);
  if (!diagnostics.good()) return exit_status::bad_input;
  const Scene& scene = loaded->scene;
  const auto counted = [](std::size_t count, const char* noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
  };
  out << fmt::format("{}: good: {}, {}, {}, {}\n", options.scene.string(),
                     counted(scene.block.size(), "block"), counted(scene.material.size(), "material"),
                     counted(scene.joint.size(), "joint"), counted(scene.measure.size(), "measure"));
  out << to_string(loaded->cost, scene.block.size()) << '\n';
  for (const std::string& line : scene.notes) out << line << '\n';
  for (const std::string& line : motion_left(scene)) out << line << '\n';
  return exit_status::done;
}

void declare_check_command(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand("check", "Read and validate a scene; lists every error");
  // Lives as long as the callback that reads it.
  const auto options = std::make_shared<CheckOptions>();
  command->add_option("SCENE", options->scene, "Scene file (TOML); - is standard input")
      ->required()
      ->type_name("");
  declare_overrides(*command, options->overrides);
  command->callback(
      [options, &context] { context.status = check_command(*options, context.out, context.err); });
}

}  // namespace ashlar
