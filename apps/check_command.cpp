#include "apps/check_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <ostream>

#include "apps/build_simulation.hpp"
#include "apps/loose_blocks.hpp"
#include "apps/override_option.hpp"
#include "apps/scene_loading.hpp"

namespace ashlar {

int check_command(const CheckOptions& options, std::ostream& out, std::ostream& err) {
  Diagnostics diagnostics;
  const std::optional<LoadedScene> loaded = load_scene(options.scene, options.overrides, diagnostics);
  std::optional<BuiltSimulation> built;
  if (loaded) built = build_simulation(*loaded, 1, diagnostics);
  if (built && loaded->scene.analysis.type == SceneAnalysis::Type::statics)
    refuse_loose_blocks(loaded->scene, built->simulation, diagnostics);
  diagnostics.print(err);
  if (!diagnostics.good()) return exit_status::bad_input;
  const Scene& scene = loaded->scene;
  const auto counted = [](std::size_t count, const char* noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
  };
  out << fmt::format("{}: good: {}, {}, {}, {}\n", options.scene.string(),
                     counted(scene.block.size(), "block"), counted(scene.material.size(), "material"),
                     counted(scene.joint.size(), "joint"), counted(scene.measure.size(), "measure"));
  return exit_status::done;
}

void declare_check_command(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand("check", "Read and validate a scene; lists every error");
  // Lives as long as the callback that reads it.
  const auto options = std::make_shared<CheckOptions>();
  command->add_option("SCENE", options->scene, "Scene file (TOML)")->required()->type_name("");
  declare_overrides(*command, options->overrides);
  command->callback(
      [options, &context] { context.status = check_command(*options, context.out, context.err); });
}

}  // namespace ashlar
