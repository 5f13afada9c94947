// Versions of the libraries the geometry layer was built with, for the records of a run.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ashlar {

/// Name and version of CGAL, Boost, GMP, MPFR and Eigen.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> geometry_library_versions();

}  // namespace ashlar
