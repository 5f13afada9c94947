// A call of a tool that is a command of this program, in a process of its own.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/program/mcp/tool.hpp"
#include "apps/program/mcp/workspace.hpp"

namespace ashlar {

/// Status and output of a command.
struct CommandOutcome {
  int status;  ///< exit status, -1 if a signal ended it
  std::string out, err;
};

struct CommandWork {
  std::function<int()> work;  ///< prints to std::cout and std::cerr, and returns an exit status
  bool limited = true;        ///< to reading what Workspace::readable() allows
  std::function<ToolAnswer(const CommandOutcome& outcome)> answer;
};

/// A command of this program. @param arguments of its command line
[[nodiscard]] std::function<int()> command_line_work(std::vector<std::string> arguments);

/// Starts the command. After the limit of seconds it is ended, and the answer is an error.
[[nodiscard]] std::unique_ptr<ToolCall> command_call(Workspace& workspace, CommandWork work);

/// The last bytes of a long text, from the beginning of a line.
[[nodiscard]] std::string last_part(const std::string& text, std::size_t most);

/// Error of a command: its messages without "ashlar: error: ".
[[nodiscard]] ToolAnswer command_error(const CommandOutcome& outcome);

/// "key=value" for each entry of the argument `set`, as --set takes them; none if it is not given.
[[nodiscard]] std::vector<std::string> overrides_of(const nlohmann::ordered_json& arguments);
/// Adds "--set=key=value" for each of them.
void add_overrides(std::vector<std::string>& words, const nlohmann::ordered_json& arguments);

}  // namespace ashlar
