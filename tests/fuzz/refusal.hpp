// Refusals of readers: each has a place and a reason.
#pragma once

#include "fuzz/targets.hpp"
#include "geometry/mesh/mesh_io.hpp"

namespace ashlar::fuzz {

/// The result of a target whose reader refused the bytes.
inline bool refused(const MeshFileError& error) {
  require(error.line() >= 0 && error.column() >= 0, "places are not negative");
  require(error.what()[0] != '\0', "a refusal has a reason");
  return false;
}

}  // namespace ashlar::fuzz
