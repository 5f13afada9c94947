// The common part of two flat faces of any shape, with holes and in several pieces, seen along a direction.
//
// A face is given by its sides, in any order. Their lines are cut where they meet the sides of the other
// face; each piece then is inside or outside the other face, or on its rim, as a whole: its middle decides.
// The rim of the common part K (the closure of the common inner points) are the pieces that are inside, and
// those on both rims with both faces at the same side. A point of K's rim is known by the features that make
// it, never by its coordinates: a corner, a crossing of two sides, a coincidence. It is a vertex of K unless
// K's rim passes straight through it; a point where several parts of K touch is one vertex. Triangles do
// not enter, so the answer cannot depend on them.
//
// Every decision is an exact sign: floating point with a tracked error where that suffices, else rational
// numbers. Only sources of this layer include this file.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "geometry/convex/contact_region.hpp"
#include "geometry/exact/direction_predicates.hpp"
#include "geometry/exact/rational_vector.hpp"

namespace ashlar {

/// A straight side between two points; the face is at its left when the direction points at the viewer.
struct FlatSide {
  int from, to;  ///< indices into the points
  int edge;      ///< its number in labels
};

/// A face, or a single edge: one side, without a face at its left.
struct FlatPiece {
  const std::vector<Vector3>* points = nullptr;
  std::vector<FlatSide> sides;
  int face = -1;  ///< its number in labels
};

/// A point of the outline with the features that carry it.
struct OverlapPoint {
  ContactFeature a, b;  ///< dimension 0: index of a point; 1: of an edge; 2: of the face
  /// m, exact; none where that piece's feature is its face.
  std::optional<RationalVector> on_a, on_b;
};

using FeaturePair = std::pair<ContactFeature, ContactFeature>;

struct FlatOverlap {
  /// K of two faces: its vertices. K of an edge and a face: both ends of each segment, in order.
  std::vector<OverlapPoint> vertices;
  /// (Area of K across the direction)^2, m^4; zero for an edge.
  Rational squared_area;
  /// Pairs of features in the outline of K (for an edge: at or within its segments), whose own common part is in the
  /// closure of K.
  std::vector<FeaturePair> closure;
};

struct FlatSetting {
  /// Not zero. Both faces are seen with it pointing at the viewer.
  RationalVector direction;
  bool coplanar = false;  ///< both pieces are in one plane across the direction
  bool floating = true;   ///< no product of two coordinates overflows; underflow is allowed for
};

/// Two faces. They may lie in different planes; the projection along the direction must be one to one on
/// each. No vertices if they have no common inner points.
[[nodiscard]] FlatOverlap overlap_faces(const FlatSetting& setting, const FlatPiece& a, const FlatPiece& b,
                                        DecisionCounts& counts);

/// The inner points of an edge (a) over the inner points of a face (b).
[[nodiscard]] FlatOverlap overlap_edge(const FlatSetting& setting, const FlatPiece& a, const FlatPiece& b,
                                       DecisionCounts& counts);

}  // namespace ashlar
