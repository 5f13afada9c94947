// `ashlar mcp`: a server of the Model Context Protocol over standard input and output, for agents.
//
// It is one thread that computes nothing: runs, and commands that take time, are copies of this process (work_process.hpp),
// so that it answers at any time. Nothing but messages of the protocol goes to standard output.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "apps/program/command_line.hpp"
#include "apps/program/mcp/workspace.hpp"

namespace ashlar {

struct McpOptions {
  std::filesystem::path folder;  ///< that clients work in
  ServerLimits limits;
};

/// Declares `ashlar mcp`.
void declare_mcp_command(CLI::App& program, CommandContext& context);

/// Serves until standard input ends, `out` cannot be written, or a signal asks it to end. Calls at work are given up then,
/// and runs are asked to end and waited for, which saves their states.
/// @param out messages for the client. @param err faults
/// @return exit status; bad_input if there is no such folder
[[nodiscard]] int mcp_command(const McpOptions& options, std::ostream& out, std::ostream& err);

}  // namespace ashlar
