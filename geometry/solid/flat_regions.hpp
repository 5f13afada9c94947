// Coplanar triangles in spite of rounded coordinates: the corners of a rotated box are some units in the last place
// off the planes of its faces, so that flatness depends on the resolution of the coordinates, which the caller
// specifies.
#pragma once

#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Regions of a closed surface: triangles connected over edges, all of whose corners are within `resolution`
/// of the plane of the region's largest triangle and which face the same way. Regions grow from the largest
/// triangle left, so that slivers, whose own planes mean nothing, go with their neighbours.
/// @param twins (3 #triangles) the half-edge on the other side of each. @param resolution m, > 0
/// @return (#triangles) region of each, numbered from 0
[[nodiscard]] std::vector<int> flat_regions(const TriangleMesh& mesh, const std::vector<int>& twins,
                                            double resolution);

}  // namespace ashlar
