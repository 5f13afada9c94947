#include "solver/library_versions.hpp"

#include <cholmod.h>

namespace ashlar {

std::vector<std::pair<std::string, std::string>> solver_library_versions() {
  int cholmod[3] = {0, 0, 0};
  cholmod_version(cholmod);
  return {{"CHOLMOD",
           std::to_string(cholmod[0]) + '.' + std::to_string(cholmod[1]) + '.' + std::to_string(cholmod[2])}};
}

}  // namespace ashlar
