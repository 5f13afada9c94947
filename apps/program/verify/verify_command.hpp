// `ashlar verify`: cases against independent references. Most are scenes with tables of checks (cases/scene_case.hpp),
// others are built in.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/program/command_line.hpp"

namespace ashlar {

struct VerifyOptions {
  std::vector<std::string> cases = {};  ///< names; empty: all
  std::filesystem::path folder = {};    ///< of a user's own cases; empty: those of the program
  std::filesystem::path kept = {};      ///< folder that scenes and results are left in; empty: none are
  bool list = false;
  bool json = false;
};

/// Declares `ashlar verify`.
void declare_verify_command(CLI::App& program, CommandContext& context);

/// Runs cases and prints, for each check, the measured value, its reference, error, tolerance and verdict, and the
/// seconds of each case. With json one object: {"passed": B, "cases": [{"name", "passed", "seconds", "checks":
/// [{"what", "measured", "reference", "error", "tolerance", "passed"}]}]}.
/// @return exit_status::done; failed if a check fails; bad_input for an unknown case, and for faults of
/// a table of cases or a check that cannot be evaluated
[[nodiscard]] int verify_command(const VerifyOptions& options, std::ostream& out, std::ostream& err);

}  // namespace ashlar
