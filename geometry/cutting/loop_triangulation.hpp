// Triangulation of flat polygons, with or without holes, with triangles of good shape: corners in sides that are
// straight but for rounding are joined to distant ones, not to each other, so that no triangle coincides with the
// adjacent face. Only sources of this layer include this file.
#pragma once

#include <array>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// The constrained Delaunay triangulation of the region bounded by loops, projected along the axis nearest to a
/// normal and decided exactly for the given corners. Loops that cross by rounding give no triangles, so that the
/// check of the mesh refuses them.
/// @param loops of indices into corners. @param normal about which triangles are counter-clockwise
[[nodiscard]] std::vector<std::array<int, 3>> triangulate_loops(const std::vector<Vector3>& corners,
                                                                const std::vector<std::vector<int>>& loops,
                                                                const Vector3& normal);

}  // namespace ashlar
