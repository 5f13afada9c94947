// The overlap of two faces from those of their cells: which corners are contact points (theory.md section
// 6.4). Sides inside a face only cut the overlap into pieces for integration; the corners they make are no
// contact points. What is left are the vertices of the overlap polygon, holes and several pieces included:
// corners of one face over the other, and rims that cross.
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

/// Joins cell overlaps by faces, ordered by (face_a, face_b). Faces that were divided because they curve have
/// no polygon: there every corner of the cell overlaps is a point, once.
[[nodiscard]] std::vector<FaceOverlap> join_by_faces(const PlacedSurface& a, const PlacedSurface& b,
                                                     const std::vector<CellOverlap>& overlaps);

}  // namespace ashlar
