// `ashlar blocks`: the blocks of a scene, before it runs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/program/command_line.hpp"

namespace ashlar {

struct BlocksOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;           ///< "key.path=value" each, in order
  std::optional<std::filesystem::path> folder;  ///< default: scene name + ".blocks"; with json: none
  bool json = false;
  std::optional<std::string> stage;  ///< name of a [[stage]]; default: all blocks, of any stage
  std::optional<std::string> force;  ///< "x,y,z" of --removable
  double wanted = 1.0;               ///< factor for which needed forces are told
  int mechanisms = 0;                ///< by limit analysis, at most; 0: none
  std::vector<std::string> borders;  ///< "x=-8" each
};

/// Declares `ashlar blocks`.
void declare_blocks_command(CLI::App& program, CommandContext& context);

/// Prints a table or JSON on out and writes blocks.vtu, .obj, .stl, .msh and sizes.py, which draws
/// sizes.svg and .png (plot_script.hpp).
/// @return exit_status::done or exit_status::bad_input.
[[nodiscard]] int blocks_command(const BlocksOptions& options, std::ostream& out, std::ostream& err);

}  // namespace ashlar
