// A solid as tetrahedra that fill it: volumes for display and clipping, not for computation.
//
// A solid that is visible as a whole from a point inside it, as every convex one is, is a star: that point joined to
// every triangle of its surface. For a convex solid the point is the centroid, whose distance from every face is at
// least a quarter of the solid's width (in three dimensions), so that no tetrahedron is flatter than the solid. For
// others it is the centroid of all points that see the whole. A solid without such points, e.g. a ring, is cut
// through its reflex edges into convex cells, which share their faces, and each cell is a star. Visibility of a
// triangle from a point is decided exactly for the given doubles.
#pragma once

#include <array>
#include <vector>

#include "geometry/cutting/cut_error.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

struct TetrahedronMesh {
  std::vector<Vector3> points;            ///< (#points), m
  std::vector<std::array<int, 4>> cells;  ///< indices into points; (b - a) x (c - a) . (d - a) > 0, exactly
};

/// Tetrahedra that meet in whole faces. The surface of a star is the solid's mesh, and its points come first, so that
/// the sum of the volumes is the solid's volume but for rounding.
/// @param resolution m, >= 0, of the coordinates. Corners of convex cells closer than this are merged; tetrahedra
/// flatter than this are omitted, such as those between triangles of one face of a rotated solid
/// @throws CutError if no point sees the solid as a whole and more than most_surface_cells are needed
[[nodiscard]] TetrahedronMesh tetrahedra_of(const Polyhedron& solid, double resolution);

/// The tetrahedra of the same solid after a translation. Cells without volume after rounding are omitted.
[[nodiscard]] TetrahedronMesh translated(TetrahedronMesh mesh, const Vector3& by);

}  // namespace ashlar
