// Versions of the libraries used by the solver layer, for the records of a run.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ashlar {

/// Name and version of CHOLMOD and oneTBB.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> solver_library_versions();

}  // namespace ashlar
