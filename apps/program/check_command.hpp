// `ashlar check`: read and validate a scene without running it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/program/command_line.hpp"

namespace ashlar {

struct CheckOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  ///< "key.path=value" each, in order
  bool json = false;                   ///< all output as one JSON object on out, for editors and scripts
};

/// Declares `ashlar check`.
void declare_check_command(CLI::App& program, CommandContext& context);

/// Lists every fault on err, or the content of the scene on out. Writes no file. As JSON:
///
///   {"good", "faults": [{"severity", "file", "line", "column", "message"}],
///    "blocks", "materials", "joints", "measures",
///    "estimate": {"sub_faces", "unknowns", "near_pairs", "memory_bytes"}, "notes": [...]}
///
/// all on out. A fault of an argument has "argument" in place of file, line and column. Without errors all keys are
/// present, with errors those of the first line alone.
/// @return exit_status::done or exit_status::bad_input.
[[nodiscard]] int check_command(const CheckOptions& options, std::ostream& out, std::ostream& err);

}  // namespace ashlar
