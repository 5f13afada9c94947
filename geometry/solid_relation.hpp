// Exact relation and distance of two closed meshes that need not be convex.
//
// The distance is that of the nearest triangles. Where the boundaries have no common point, one solid is
// inside the other or they are apart; one point of each decides. Where they have,
//   the interiors meet  iff  A's boundary enters the interior of B, or B's that of A, or A = B:
// a part of int A n int B whose boundary is in both boundaries is bounded by all of both (each is connected).
// Two triangles that cross in inner points of both settle it. Otherwise the boundary of B meets the inside of
// a triangle of A only in edges of B that lie in its plane, so the lines of those edges cut it into cells
// that are each inside, outside or on B as a whole; one rational point of each cell is located by counting
// the crossings of a ray. A cell on B tells by the sense of the two normals. Triangles that B does not
// reach need no cell: their status is that of a neighbour.
#pragma once

#include <array>
#include <vector>

#include "geometry/contact_direction.hpp"
#include "geometry/contact_type.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

struct SolidRelation {
  Relation relation = Relation::apart;
  double squared_distance = 0.0;  ///< m^2, correctly rounded
  /// Triangles of A and B at that (rounded) distance, in order; empty if the solids cross.
  std::vector<std::array<int, 2>> nearest;
  DecisionCounts decided_by;
};

/// @param a,b closed, connected, outward surfaces without self-intersections (those of a Polyhedron).
[[nodiscard]] SolidRelation relate_solids(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace ashlar
