// A solid as tetrahedra that fill it: volumes to look at and to clip, not elements to compute with.
//
// A solid that can be seen as a whole from some point inside it, as every convex one can, is a star: that
// point joined to every triangle of its surface. Of a convex solid the point is the centroid, which is at least a
// quarter of the solid's width away from every face (in three dimensions), so that no tetrahedron is flatter than
// the solid; of others it is the centroid of all points that see the whole. A solid that no point sees as a whole, as a
// ring, is cut through its reflex edges into convex cells, which share their faces, and each cell is a star. Whether a
// point sees a triangle is decided exactly, on the given doubles.
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

/// Tetrahedra that meet in whole faces. The surface of a star is the solid's mesh, and its points come first, so that the
/// sum of the volumes is the solid's volume but for rounding.
/// @param resolution m, >= 0: what the coordinates are known to. Corners of convex cells that are nearer to each other
/// become one; tetrahedra that are flatter than that are left out, such as lie between triangles of one face of a turned
/// solid
/// @throws CutError if no point sees the solid as a whole and there are more than most_surface_cells
[[nodiscard]] TetrahedronMesh tetrahedra_of(const Polyhedron& solid, double resolution);

/// Those of the same solid elsewhere. Cells that rounding leaves without volume are left out.
[[nodiscard]] TetrahedronMesh translated(TetrahedronMesh mesh, const Vector3& by);

}  // namespace ashlar
