// Axes that turn with solids, and areas of their surfaces.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/solid/polyhedron.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Sum of the areas of all triangles, m^2.
[[nodiscard]] double surface_area(const TriangleMesh& mesh);

/// Area of the largest face, m^2, the first of faces that are larger by no more than `resolution`.
[[nodiscard]] double largest_face_area(const Polyhedron& solid, double resolution);

/// Axes for boxes that rotate with a scene: the selection by boxes, and the division of faces, must not depend on the
/// scene's orientation. Along the largest face and its longest side, the likely directions of most of a scene.
/// @param resolution faces and sides that are larger by no more than this share are equal: the first is taken
/// @return right-handed, by columns; the third is the face's normal. Without solids the coordinate axes
[[nodiscard]] Eigen::Matrix3d axes_along_largest_face(const std::vector<const Polyhedron*>& solids,
                                                      double resolution);

}  // namespace ashlar
