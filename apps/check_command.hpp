// `ashlar check`: read and validate a scene without running it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/command_line.hpp"

namespace ashlar {

struct CheckOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  ///< "key.path=value" each, in order
};

/// Declares `ashlar check`.
void declare_check_command(CLI::App& program, CommandContext& context);

/// Lists every fault on err, or says on out what the scene holds. Writes no file.
/// @return exit_status::done or exit_status::bad_input.
[[nodiscard]] int check_command(const CheckOptions& options, std::ostream& out, std::ostream& err);

}  // namespace ashlar
