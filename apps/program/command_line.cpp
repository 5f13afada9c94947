#include "apps/program/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <new>
#include <ostream>
#include <system_error>
#include <utility>

#include "apps/program/blocks/blocks_command.hpp"
#include "apps/program/check_command.hpp"
#include "apps/program/contacts/contacts_command.hpp"
#include "apps/program/contacts/integrate_command.hpp"
#include "apps/program/fragility/fragility_command.hpp"
#include "apps/program/import/import_command.hpp"
#include "apps/program/mcp/mcp_command.hpp"
#include "apps/program/new/new_command.hpp"
#include "apps/program/run/rank_agreement.hpp"
#include "apps/program/run/run_options.hpp"
#include "apps/program/schema_command.hpp"
#include "apps/program/spectrum/spectrum_command.hpp"
#include "apps/program/study/study_command.hpp"
#include "apps/program/sweep/sweep_command.hpp"
#include "apps/program/verify/verify_command.hpp"
#include "apps/program/view/movie_command.hpp"
#include "apps/program/view/picture_command.hpp"
#include "apps/program/view/view_command.hpp"
#include "apps/results/folder/program_version.hpp"
#include "apps/results/system/output_file.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/toml/fault_text.hpp"

namespace ashlar {
namespace {

// In the order of --help.
constexpr std::array<CommandDeclaration, 17> commands = {
    declare_new_command,       declare_import_command, declare_run_command,      declare_sweep_command,
    declare_fragility_command, declare_view_command,   declare_picture_command,  declare_movie_command,
    declare_check_command,     declare_blocks_command, declare_contacts_command, declare_integrate_command,
    declare_verify_command,    declare_study_command,  declare_spectrum_command, declare_schema_command,
    declare_mcp_command};

// CLI11 only says that a sub-command is required.
void refuse_unknown_command(const CLI::App& program, const std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments.front().starts_with('-')) return;
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), arguments.front()) != names.end()) return;
  throw CLI::ParseError(fmt::format("unknown command ({}), {}one of {} is needed", arguments.front(),
                                    guess(arguments.front(), names), fmt::join(names, ", ")),
                        CLI::ExitCodes::InvalidError);
}

/// Ranks share runs only; help and the version are told by the first.
void refuse_on_ranks(const std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments.front().starts_with('-') || arguments.front() == "run") return;
  if (std::find(arguments.begin(), arguments.end(), "--help") != arguments.end()) return;
  throw CLI::ParseError(
      fmt::format("several processes (mpiexec) share runs only, `ashlar run` is needed, or one "
                  "process for `ashlar {}`",
                  arguments.front()),
      CLI::ExitCodes::InvalidError);
}

/// The same without treatment of exceptions.
int parse_and_run(std::vector<std::string> arguments, std::ostream& out, std::ostream& err,
                  const RunRanks* ranks) {
  CLI::App program("Ashlar: high-order 3-D discontinuous deformation analysis", "ashlar");
  program.allow_windows_style_options(false);  // "/folder/scene.toml" is a name of a file on every system
  CommandContext context{out, err, exit_status::done, ranks};
  program.require_subcommand(1);
  program.set_version_flag("--version", version_text, "Version of the program, its compiler and libraries");
  program.footer("Exit status: 0 done; 1 the run failed; 2 bad input or usage; 130 interrupted.");
  for (const CommandDeclaration declare : commands) declare(program, context);
  program.failure_message([](const CLI::App*, const CLI::Error& error) {
    return fmt::format("ashlar: error: {}\nRun with --help for more information.\n", error.what());
  });
  // As in other programs: help, help COMMAND.
  if (!arguments.empty() && arguments.front() == "help") {
    std::rotate(arguments.begin(), arguments.begin() + 1, arguments.end());
    arguments.back() = "--help";
  }
  if (arguments.empty()) {
    err << program.help();
    return exit_status::bad_input;
  }
  try {
    refuse_unknown_command(program, arguments);
    if (are_several(ranks)) refuse_on_ranks(arguments);
    // CLI11 takes arguments last first.
    std::reverse(arguments.begin(), arguments.end());
    program.parse(arguments);
  } catch (const CLI::ParseError& error) {
    // --help and --version end the parsing in this way too; they are no faults.
    return program.exit(error, out, err) == 0 ? exit_status::done : exit_status::bad_input;
  }
  if (out.flush()) return context.status;
  err << "ashlar: error: standard output cannot be written\n";
  return exit_status::failed;
}

}  // namespace

int exit_status::of(const std::exception& failure) {
  const auto* error = dynamic_cast<const std::system_error*>(&failure);
  return error != nullptr && is_fault_of_device(error->code()) ? failed : bad_input;
}

int run_command_line(std::vector<std::string> arguments, std::ostream& out, std::ostream& err,
                     const RunRanks* ranks) {
  if (are_several(ranks)) return parse_and_run(std::move(arguments), out, err, ranks);
  // Faults of the input do not end here; these are failures of the program.
  try {
    return parse_and_run(std::move(arguments), out, err, ranks);
  } catch (const std::bad_alloc& error) {
    err << "ashlar: error: " << missing_memory(error) << '\n';
  } catch (const std::exception& error) {
    err << "ashlar: error: " << fault_text(error) << '\n';
  }
  return exit_status::failed;
}

}  // namespace ashlar
