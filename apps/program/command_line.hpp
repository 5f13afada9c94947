// The command line of `ashlar`: one sub-command per task.
//
// A command is one file, x_command.{hpp,cpp}, with a function that declares its sub-command, and one line in
// the list of command_line.cpp.
#pragma once

#include <exception>
#include <iosfwd>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ashlar {

struct RunRanks;  // run_ranks.hpp

/// Exit status of the program.
namespace exit_status {
inline constexpr int done = 0;
inline constexpr int failed = 1;         ///< the run failed; the last accepted state is saved
inline constexpr int bad_input = 2;      ///< faults in files, arguments or usage; nothing was written
inline constexpr int interrupted = 130;  ///< stopped by the user; state saved

/// Of a failure: `failed` if the system has it (a full disk, a device that fails), otherwise `bad_input`.
[[nodiscard]] int of(const std::exception& failure);
}  // namespace exit_status

/// Streams and status of a command.
struct CommandContext {
  std::ostream& out;  ///< results
  std::ostream& err;  ///< faults and progress
  int status = exit_status::done;
  const RunRanks* ranks = nullptr;  ///< processes that share a run; null: this one alone
};

/// Declares a sub-command on the program. Its callback runs the command and sets the context's status.
using CommandDeclaration = void (*)(CLI::App& program, CommandContext& context);

/// Parses and runs. A failure of the program, e.g. a result that cannot be written, goes to `err` too.
/// @param arguments without the program's name. @param ranks null: this process alone. Commands other than `run` are
/// refused on several. Collective; failures of the program are thrown on several ranks, as the others may wait
/// @return exit status.
[[nodiscard]] int run_command_line(std::vector<std::string> arguments, std::ostream& out, std::ostream& err,
                                   const RunRanks* ranks = nullptr);

}  // namespace ashlar
