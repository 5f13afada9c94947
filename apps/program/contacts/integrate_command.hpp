// `ashlar integrate`: the moments of a mesh.
#pragma once

#include <string>

#include "apps/program/command_line.hpp"

namespace ashlar {

struct IntegrateOptions {
  std::string mesh;
  int degree = 0;  ///< 0 to 60
  bool json = false;
};

/// Declares `ashlar integrate`.
void declare_integrate_command(CLI::App& program, CommandContext& context);

/// Prints the integrals of X^a Y^b Z^c over the solid, a + b + c <= degree, each the exact value rounded once
/// (moments.hpp). With json: {"degree": N, "moments": [{"a": 0, "b": 0, "c": 0, "value": V}, ...]}.
/// @return exit_status::done; bad_input for a mesh that bounds no solid or a moment beyond the largest double
[[nodiscard]] int integrate_command(const IntegrateOptions& options, std::ostream& out, std::ostream& err);

}  // namespace ashlar
