// The surface of a block as contact sees it: faces divided into flat cells in reference coordinates. Cells
// carry the polyhedron's face they are part of; an edge between two cells of one face is an inner edge by
// that attribute and is never a contact feature. The topology is constant; only the positions of its points
// move.
#pragma once

#include <array>
#include <vector>

#include "geometry/polyhedron.hpp"

namespace ashlar {

/// A flat convex piece of one face: a whole convex face, or a triangle of it.
struct SurfaceCell {
  int face;  ///< index into Polyhedron::faces()
  std::vector<int>
      corners;  ///< at least 3, indices into SubFaceSurface::points, counter-clockwise from outside
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
};

/// Constant after construction.
struct SubFaceSurface {
  std::vector<Vector3> points;  ///< reference coordinates, m
  std::vector<SurfaceCell> cells;
  std::vector<SurfaceEdge> edges;
  std::vector<SurfaceVertex> vertices;
  std::vector<double> face_share;                 ///< (#faces) area of a face over its number of corners, m^2
  std::vector<std::vector<int>> face_neighbours;  ///< (#faces) faces that share an edge with it, increasing
  bool divided = false;                           ///< true if faces were divided because the block may curve
};

/// Divides every face uniformly. The division is conforming: cells of neighbouring faces share their sides.
/// @param levels 0: convex faces stay whole, others become the triangles of the mesh; k >= 1: all triangles
/// of the mesh
///   are split into 4^k. @throws std::invalid_argument unless 0 <= levels <= 8
[[nodiscard]] SubFaceSurface divide_surface(const Polyhedron& solid, int levels);

}  // namespace ashlar
