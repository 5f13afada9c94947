// The surface of a block for contact detection: flat cells in reference coordinates. An affine block has whole convex
// faces as cells; the faces of a block that may curve are divided into triangles. Cells refer to the polyhedron's
// face of which they are part, their sides to the polyhedron's edge: a side between two cells of one face is thereby
// marked as an inner side and is never a contact feature. The topology is constant; only the positions of its points
// change.
#pragma once

#include <array>
#include <vector>

#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// A flat convex piece of one face.
struct SurfaceCell {
  int face;  ///< index into Polyhedron::faces()
  std::vector<int>
      corners;  ///< at least 3, indices into SubFaceSurface::points, counter-clockwise from outside
  /// (#corners) the edge of the polyhedron that side k, from corner k to the next, is a piece of; -1: an
  /// inner side.
  std::vector<int> rim;
  std::vector<int> across = {};  ///< (#corners) the face on the other side of side k, -1: an inner side
  /// (#corners) true if side k is a reflex edge: there the solid continues beyond the side, below both faces
  std::vector<bool> reflex = {};
};

/// A piece of an edge of the polyhedron.
struct SurfaceEdge {
  std::array<int, 2> ends;   ///< points; the left cell has it in this direction
  std::array<int, 2> cells;  ///< left and right
  bool convex;               ///< as PolyhedronEdge::convex
};

/// A point on an edge of the polyhedron, its corners included.
struct SurfaceVertex {
  int point;
  std::vector<int> neighbours;  ///< points at the other ends of all cell sides that end here
  std::vector<int> cells;       ///< cells around it, increasing
  bool reflex = false;          ///< true if a reflex edge ends here
};

/// Constant after construction.
struct SubFaceSurface {
  std::vector<Vector3> points;  ///< reference coordinates, m
  std::vector<SurfaceCell> cells;
  std::vector<SurfaceEdge> edges;
  std::vector<SurfaceVertex> vertices;
  std::vector<int> vertex_of_point;        ///< (#points) index into vertices; -1: none
  std::vector<std::vector<int>> cells_at;  ///< (#points) cells with this corner, increasing
  std::vector<std::vector<int>> edges_of;  ///< (#cells) edges beside a cell, increasing
  std::vector<double> face_share;          ///< (#faces) area of a face over its number of corners, m^2
  std::vector<std::vector<int>> convex_neighbours;  ///< (#faces) faces across convex edges of it, increasing
  bool divided = false;  ///< true if faces were divided because the block may curve
};

/// Convex faces whole, others as the triangles of the mesh: for blocks whose faces stay flat. Its edges and
/// vertices are those of the polyhedron, whatever points the mesh has inside them.
[[nodiscard]] SubFaceSurface whole_surface(const Polyhedron& solid);

/// The mesh's triangles, split into 4^levels each. The division is conforming: cells of neighbouring faces
/// share their sides. @throws std::invalid_argument unless 0 <= levels <= 8
[[nodiscard]] SubFaceSurface divide_surface(const Polyhedron& solid, int levels);

/// A conforming division into triangles, with the rims known.
/// @param points reference coordinates of at least all corners; the surface has those that cells use, in the
/// order of their first use
/// @param cells triangles that cover every face of the solid
[[nodiscard]] SubFaceSurface surface_of_triangles(const Polyhedron& solid, const std::vector<Vector3>& points,
                                                  std::vector<SurfaceCell> cells);

}  // namespace ashlar
