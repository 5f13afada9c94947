#include "apps/program/run/run_options.hpp"

#include <CLI/CLI.hpp>
#include <limits>
#include <memory>

#include "apps/program/number_option.hpp"
#include "apps/program/run/override_option.hpp"
#include "apps/program/run/run_command.hpp"

namespace ashlar {

void declare_run_command(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand("run", "Simulate a scene and write its result folder");
  // Shared with the callback that reads it.
  const auto options = std::make_shared<RunOptions>();
  command->add_option("SCENE", options->scene, "Scene file (TOML); - is standard input")
      ->required()
      ->type_name("");
  command->add_option("-o,--out", options->out, "Result folder (default: scene name + .out)")
      ->type_name("DIR");
  declare_overrides(*command, options->overrides);
  command->add_flag("--resume", options->resume, "Go on from the checkpoint in the result folder");
  command->add_flag("--force", options->force,
                    "Replace results in the result folder; --resume goes on with them instead");
  command
      ->add_option("--checkpoint", options->checkpoint,
                   "Seconds between checkpoints (default: 1, 2, 4, ... to 60, in at most 3 % of the run; 0: "
                   "after every step)")
      ->type_name("SECONDS")
      ->transform(real_number_option({.low = 0.0, .words = "a number of seconds >= 0"}).description(">= 0"));
  command->add_option("-t,--threads", options->threads, "Number of threads")
      ->type_name("N")
      ->transform(whole_number_option(1));
  command->add_flag("--quiet", options->quiet, "No progress on stderr");
  command->add_flag("--view", options->view, "Write view.html into the result folder at the end");
  command->add_flag("--all-errors", options->all_errors,
                    "Estimate the errors of the orders of all blocks (default: in at most 5 % of the run)");
  command
      ->add_option("--explain-contacts", options->explained_pair,
                   "Print the contacts of two blocks at the end, and why others were left out")
      ->type_name("A,B");
  command->callback([options, &context] {
    context.status = run_command(*options, context.out, context.err, context.ranks);
  });
}

}  // namespace ashlar
