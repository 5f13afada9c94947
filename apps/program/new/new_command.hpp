// `ashlar new`: a commented scene to begin with.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/program/command_line.hpp"

namespace ashlar {

struct NewOptions {
  std::string kind;                           ///< of starting_scenes.hpp
  std::optional<std::filesystem::path> file;  ///< default: KIND.toml
  bool force = false;                         ///< replace the file
};

/// Declares `ashlar new`.
void declare_new_command(CLI::App& program, CommandContext& context);

/// Writes the scene, and scene.schema.json beside it, with which editors complete and check its keys.
/// @return exit_status::done or exit_status::bad_input
[[nodiscard]] int new_command(const NewOptions& options, std::ostream& out, std::ostream& err);

}  // namespace ashlar
