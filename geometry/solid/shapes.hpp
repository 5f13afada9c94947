// The shapes a scene can name besides a mesh file. All are outward triangle meshes that bound a solid.
#pragma once

#include <span>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Axis-parallel box of 12 triangles. @param low,high opposite corners, m. @throws std::invalid_argument
/// unless low < high in every component and all are finite.
[[nodiscard]] TriangleMesh make_box(const Vector3& low, const Vector3& high);

/// Convex hull (exact predicates): its corners in the order in which they were given, each facet a fan of
/// triangles from the first of its corners. Other points are dropped, those on a facet or a side too.
/// @param points at least 4, m. @throws std::invalid_argument if they are coplanar, fewer than 4 or not
/// finite.
[[nodiscard]] TriangleMesh make_convex_hull(std::span<const Vector3> points);

/// Sphere from an icosahedron whose triangles are split `subdivisions` times (20 * 4^subdivisions triangles),
/// with all points on the sphere. @param radius > 0, m. @param subdivisions 0 to 7. @throws
/// std::invalid_argument.
[[nodiscard]] TriangleMesh make_sphere(const Vector3& center, double radius, int subdivisions);

}  // namespace ashlar
