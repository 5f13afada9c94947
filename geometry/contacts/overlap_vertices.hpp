// The overlap of two faces from those of their cells: selection of contact points among the corners (theory.md
// section 6.4). Sides inside a face only divide the overlap for integration; their corners are not contact points.
// The remaining points are the vertices of the overlap polygon, including holes and several parts: corners of one
// face over the other, and crossings of edges.
#pragma once

#include <vector>

#include "geometry/contacts/contact_search.hpp"

namespace ashlar {

/// A contact point: corner `corner` of overlap `overlap` of the list.
struct FaceOverlapPoint {
  int overlap;
  int corner;
};

/// The overlap of a face of a and one of b.
struct FaceOverlap {
  int face_a;
  int face_b;
  std::vector<int> cells;                ///< indices into the list of cell overlaps
  std::vector<FaceOverlapPoint> points;  ///< each vertex of the polygon once, in the order of the list
};

/// Joins cell overlaps by faces, ordered by (face_a, face_b). Faces divided because they curve have no polygon: all
/// corners of the cell overlaps are points, once each.
[[nodiscard]] std::vector<FaceOverlap> join_by_faces(const PlacedSurface& a, const PlacedSurface& b,
                                                     const std::vector<CellOverlap>& overlaps);

}  // namespace ashlar
