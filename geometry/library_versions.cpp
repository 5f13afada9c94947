#include "geometry/library_versions.hpp"

#include <CGAL/version.h>
#include <gmp.h>
#include <mpfr.h>

#include <Eigen/Core>
#include <boost/preprocessor/stringize.hpp>
#include <boost/version.hpp>

namespace ashlar {

std::vector<std::pair<std::string, std::string>> geometry_library_versions() {
  const auto dotted = [](int major, int minor, int patch) {
    return std::to_string(major) + '.' + std::to_string(minor) + '.' + std::to_string(patch);
  };
  return {{"CGAL", BOOST_PP_STRINGIZE(CGAL_VERSION)},
           {"Boost", dotted(BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
           {"GMP", gmp_version}, {"MPFR", mpfr_get_version()},
           {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)}};
}

}  // namespace ashlar
