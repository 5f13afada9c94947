// Optional changes to mesh files that are not a single valid solid: welding of near corners, separation of surfaces,
// reversal of surfaces. They are made on request only, and nothing is proven: Polyhedron checks the result exactly,
// as for any other file.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Counts of weld_corners.
struct WeldCount {
  std::size_t corners = 0;    ///< moved to others, or equal to them
  std::size_t triangles = 0;  ///< removed because two of their corners were merged
};

/// Merges points within `distance`: each, in their order, is moved to the nearest earlier one that was not moved
/// itself, so that no point moves farther than `distance`. Unused points are removed.
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
