// Volume and face normals of triangle surfaces, evaluated exactly on the given doubles and rounded once.
#pragma once

#include <span>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Volume enclosed by a closed and consistently oriented surface, the sum over its triangles a, b, c of
/// (a_z + b_z + c_z) / 6 times twice the area projected along z (divergence theorem for (0, 0, z)).
/// @return m^3, correctly rounded; negative if the triangles are clockwise from outside; infinite on
/// overflow.
[[nodiscard]] double signed_volume(const TriangleMesh& mesh);

/// Direction of the area vector of some triangles, sum (b - a) x (c - a).
/// @param triangles indices into mesh.triangles.
/// @return unit vector, the exact direction rounded; zero if the area vector is exactly zero.
[[nodiscard]] Vector3 area_direction(const TriangleMesh& mesh, std::span<const int> triangles);

}  // namespace ashlar
