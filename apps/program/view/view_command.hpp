// `ashlar view`: the results of a run as a page for the browser.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "apps/program/command_line.hpp"

namespace ashlar {

struct ViewCommandOptions {
  std::filesystem::path folder;               ///< result folder
  std::optional<std::filesystem::path> page;  ///< empty: view.html in the folder
  std::optional<std::string> relative_to;     ///< as ViewOptions::relative_to
  bool all_points = false;                    ///< includes contact points of frames with many of them
};

/// Writes the page and prints its path and content.
/// @return exit status; bad_input if the folder cannot be read.
[[nodiscard]] int view_command(const ViewCommandOptions& options, std::ostream& out, std::ostream& err);

/// Declares --relative-to, also used for pictures and films.
void declare_relative_to(CLI::App& command, std::optional<std::string>& block);

void declare_view_command(CLI::App& program, CommandContext& context);

}  // namespace ashlar
