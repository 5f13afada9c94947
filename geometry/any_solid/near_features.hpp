// Features of two solids that may carry a local minimum of their distance, by their boxes and by the existence of
// normal cones (solid_features.hpp). Only sources of this layer include this file.
#pragma once

#include <array>
#include <vector>

#include "geometry/any_solid/face_polygon_overlap.hpp"
#include "geometry/any_solid/solid_features.hpp"

namespace ashlar {

/// Corners (index: the point of the mesh), edges and faces, by the sum of the dimensions of a pair.
using NearFeatures = std::array<std::vector<FeaturePair>, 5>;

/// @param squared_limit m^2, of the distance of their boxes
[[nodiscard]] NearFeatures near_features(const SolidFeatures& a, const SolidFeatures& b,
                                         double squared_limit);

}  // namespace ashlar
