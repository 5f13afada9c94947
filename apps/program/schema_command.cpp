#include "apps/program/schema_command.hpp"

#include <CLI/CLI.hpp>
#include <ostream>

#include "apps/results/text/json_text.hpp"
#include "apps/scene/build/scene_schema.hpp"

namespace ashlar {

void declare_schema_command(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand("schema", "A JSON schema of scenes, for editors and validators");
  command->callback([&context] {
    context.out << json_text(scene_schema(), 2) << '\n';
    context.status = exit_status::done;
  });
}

}  // namespace ashlar
