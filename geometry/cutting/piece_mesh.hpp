// Rounded data of parts of a cell complex: their surface as triangles, and the distance of a section. Only sources of
// this layer include this file.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "geometry/cutting/cell_complex.hpp"

namespace ashlar {

/// The outward surface made of faces: its corners, and the regions between them divided into triangles. If an outline
/// in one plane has holes or touches itself, the faces' own loops are divided instead, with points in straight sides.
/// Points with equal rounded coordinates are merged, and triangles without area are omitted.
/// @param faces and whether the body is below the plane of each. @param merged (#points) see merge_points
[[nodiscard]] TriangleMesh mesh_of_faces(const CellComplex& complex,
                                         const std::vector<std::pair<int, bool>>& faces,
                                         const std::vector<int>& merged);

/// A face as triangles, counter-clockwise as seen from above its plane. Points in its straight sides are corners too,
/// and no triangle has zero area (exactly). @return indices into ComplexFace::points
[[nodiscard]] std::vector<std::array<int, 3>> triangles_of_face(const CellComplex& complex, int face);

/// (#points): the first of the points merged with each: those that round to within a resolution of each other in
/// every coordinate, and points connected by such. @param resolution m, >= 0
[[nodiscard]] std::vector<int> merge_points(const CellComplex& complex, double resolution);

/// m: distance from a point of a plane to the section of a cell, rounded; infinite if the plane does not divide it.
[[nodiscard]] double distance_from_section(const CellComplex& complex, int cell, const ExactPlane& plane,
                                           const ExactPoint& from);

}  // namespace ashlar
