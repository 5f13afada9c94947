// Flat polygons, with or without holes, as triangles of good shape: corners in sides that are straight to rounding only
// are joined to far ones, not to each other, so that no triangle on them lies along the face beside. Only
// sources of this layer include this file.
#pragma once

#include <array>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// The constrained Delaunay triangulation of what loops bound, seen along the axis nearest to a normal and decided
/// exactly on the given corners. Loops that rounding has made cross give no triangles, for the check of the mesh to
/// refuse. @param loops of indices into corners. @param normal that triangles are counter-clockwise around
[[nodiscard]] std::vector<std::array<int, 3>> triangulate_loops(const std::vector<Vector3>& corners,
                                                                const std::vector<std::vector<int>>& loops,
                                                                const Vector3& normal);

}  // namespace ashlar
