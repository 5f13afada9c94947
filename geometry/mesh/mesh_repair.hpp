// What may be asked for where a mesh file is no single clean solid: near corners made one, surfaces told
// apart, surfaces turned. Nothing here is done unasked, and nothing is proven: Polyhedron checks the result
// exactly, as that of any other file.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// What weld_corners did.
struct WeldCount {
  std::size_t corners = 0;    ///< that were moved onto others, or were equal to them
  std::size_t triangles = 0;  ///< left out because two of their corners became one
};

/// Makes points within `distance` one: each, in their order, becomes the nearest of those before it that was
/// not moved itself, so that no point moves farther than `distance`. Points that no triangle uses any more go.
/// @param distance in the unit of the points, > 0
/// @throws std::invalid_argument "what is wrong (value), what is allowed" if it is above a tenth of the mesh's
/// greatest extent, or so small that coordinates cannot tell it from zero
WeldCount weld_corners(TriangleMesh& mesh, double distance);

/// The closed surfaces of a mesh, in the order of their first triangles, each with the points that it uses.
/// Triangles belong together that share an edge. Where surfaces touch along an edge, more than two triangles
/// share it; then two neighbours on the surface are those between which the inside lies, as bodies do that are
/// put together face to face. Triangles that no closed surface is made of are components too.
/// @param mesh triangles counter-clockwise from outside
/// @param coincident rad, >= 0: faces that make a smaller angle about a common edge lie on each other
[[nodiscard]] std::vector<TriangleMesh> closed_components(const TriangleMesh& mesh, double coincident);

/// The signed volume, rounded in each operation: negative for a surface that is inside out.
[[nodiscard]] double rounded_volume(const TriangleMesh& mesh);

/// Turns every triangle over.
void turn_inside_out(TriangleMesh& mesh);

}  // namespace ashlar
