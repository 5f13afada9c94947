// Versions of the program and its tools, for --version and for the records of a run.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ashlar {

/// Major, minor and patch number, as "0.3.0".
[[nodiscard]] std::string program_version();

/// Name and version: the compiler first, then the libraries.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> tool_versions();

/// "ashlar", program_version() and a line for each of tool_versions.
[[nodiscard]] std::string version_text();

}  // namespace ashlar
