// Repair of invalid surfaces: fills holes, removes triangles that are duplicate or have no area, and makes
// orientations consistent. It is heuristic and made on request only, by CGAL's polygon mesh processing; Polyhedron
// checks the result exactly.
#pragma once

#include <cstddef>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Counts of repair_surface.
struct SurfaceRepair {
  std::size_t removed = 0;  ///< triangles without area by their corners, or there before
  std::size_t holes = 0;    ///< filled
  std::size_t added = 0;    ///< triangles in them
  bool turned = false;      ///< the whole surface was inside out
  bool complete = true;     ///< true if all holes could be filled
};

/// Repairs one surface. Points with equal coordinates are merged. Triangles that repeat a corner or another triangle
/// are removed; the others are reversed until neighbours are consistent. If more than two meet in an edge, or fans
/// meet in a point only, points are doubled so that the surface is cut open there. Each hole is covered with
/// triangles without new points, unless it has more than a thousand edges. An inverted surface is reversed. Points
/// keep their coordinates. Self-intersections remain.
/// @param mesh finite coordinates, indices in range; comes out closed if `complete`
SurfaceRepair repair_surface(TriangleMesh& mesh);

}  // namespace ashlar
