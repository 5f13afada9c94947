// The placed, undeformed shape of a block, as all processes of a run know it.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

struct PlacedVolume {
  Vector3 centroid;  ///< m
  double volume;     ///< m^3
};

}  // namespace ashlar
