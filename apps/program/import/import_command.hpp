// `ashlar import`: a scene from the model of another program.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/program/command_line.hpp"

namespace ashlar {

struct ImportOptions {
  std::filesystem::path file;
  std::optional<std::filesystem::path>
      out;                         ///< scene to write; default: the name of the file, in the working folder
  std::vector<std::string> fixed;  ///< names or globs of blocks that never move, as in the model
  bool force = false;              ///< replace the scene and its OBJ file
};

/// Declares `ashlar import`.
void declare_import_command(CLI::App& program, CommandContext& context);

/// Writes the scene, and an OBJ file with its blocks beside it. Parts that are left out are listed on `err`, a line each.
/// @return exit_status::done; exit_status::bad_input, and nothing is written
[[nodiscard]] int import_command(const ImportOptions& options, std::ostream& out, std::ostream& err);

}  // namespace ashlar
