// Making a solid of a surface that is none yet: holes filled, triangles that are double or have no area left
// out, triangles turned alike. It is guesswork, done where a user asks for it only; CGAL's polygon mesh
// processing does it, and Polyhedron checks the result exactly.
#pragma once

#include <cstddef>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// What repair_surface did.
struct SurfaceRepair {
  std::size_t removed = 0;  ///< triangles without area by their corners, or there before
  std::size_t holes = 0;    ///< filled
  std::size_t added = 0;    ///< triangles in them
  bool turned = false;      ///< the whole surface was inside out
  bool complete = true;     ///< whether all holes could be filled
};

/// Repairs one surface. Points with equal coordinates become one, triangles that repeat a corner or another
/// triangle go, the others are turned until neighbours run alike; where more than two meet in an edge, or fans
/// meet in a point only, points are doubled so that the surface is cut open there. Each hole is covered with
/// triangles without new points, unless it has more than a thousand edges, and a surface that is inside out is turned. Points keep their coordinates.
/// Self-intersections stay.
/// @param mesh finite coordinates, indices in range; comes out closed if `complete`
SurfaceRepair repair_surface(TriangleMesh& mesh);

}  // namespace ashlar
