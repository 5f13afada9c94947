// `ashlar contacts`: the exact contact report of two meshes, or of a list of pairs.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "apps/program/command_line.hpp"

namespace ashlar {

struct ContactsOptions {
  std::string a, b;                  ///< mesh files; not with pairs
  std::optional<std::string> pairs;  ///< file with a line `A B` for each pair
  std::optional<double> distance;    ///< m, >= 0
  std::optional<double> angle;       ///< deg, 0 to 90
  bool json = false;
};

/// Declares `ashlar contacts`.
void declare_contacts_command(CLI::App& program, CommandContext& context);

/// Prints reports on out and faults on err: for two meshes "FILE:LINE:COLUMN: error: ..." for every defect of both;
/// for a list the same after the place of the file's name in the list. For a bad pair of a list {"error": [...]}
/// (text: "error") is printed in its place, and later pairs are processed as usual.
/// @return exit_status::done, or exit_status::bad_input if there was any fault.
[[nodiscard]] int contacts_command(const ContactsOptions& options, std::ostream& out, std::ostream& err);

}  // namespace ashlar
