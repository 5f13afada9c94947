// `ashlar schema`: a JSON schema of scenes.
#pragma once

#include "apps/program/command_line.hpp"

namespace ashlar {

void declare_schema_command(CLI::App& program, CommandContext& context);

}  // namespace ashlar
