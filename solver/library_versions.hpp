// Versions of the libraries the solver layer runs with, for the records of a run.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ashlar {

/// Name and version of CHOLMOD and oneTBB.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> solver_library_versions();

}  // namespace ashlar
