// The contact region K with its vertices, carriers and correctly rounded coordinates.
#pragma once

#include <vector>

#include "geometry/contact_type.hpp"
#include "geometry/convex/convex_shape.hpp"
#include "geometry/convex/overlap_polygon.hpp"
#include "geometry/convex/plane_heights.hpp"
#include "geometry/exact/direction_constructions.hpp"
#include "geometry/exact/direction_predicates.hpp"

namespace ashlar {

/// A face of a shape: corner, edge, facet or (dimension 3) the solid itself.
struct ContactFeature {
  int dimension = -1;
  int index = -1;  ///< of the corner, edge or facet; -1 for the solid, and at a resolution for a side or
                   ///< polygon of the plane set that is not an edge or facet of the shape

  friend bool operator==(const ContactFeature&, const ContactFeature&) = default;
};

/// One vertex of a contact region.
struct RegionVertex {
  ContactFeature a, b;  ///< the faces that carry it
  Vector3 on_a, on_b;   ///< m, correctly rounded; on_a - on_b = w exactly but for the rounding

  [[nodiscard]] PairKind pair() const { return pair_kind(a.dimension, b.dimension); }
};

/// K on A and K - w on B.
struct ContactRegion {
  ContactType type = ContactType::crossing;
  int a_dimension = -1, b_dimension = -1;  ///< of the carriers
  int dimension = -1;                      ///< of K: 0 point, 1 segment, 2 polygon, 3 solid
  ContactFeature a, b;                     ///< the carriers of K
  /// The vertices of K, each once. A polygon's are counter-clockwise when w (from B to A) points at the
  /// viewer, starting anywhere; a segment's and a solid's in no particular order.
  std::vector<RegionVertex> points;
};

/// A plane set over corners of a shape.
struct ShapePlane {
  const ConvexShape& shape;
  PlaneSet set;
};

/// The region along a direction: the common part of two plane sets seen along w.
/// @param height the difference p - q of a corner of A and
/// one of B that bound their shapes along w; @param touching that difference is zero along w.
/// @return a region without points (dimension -1) if the sets have nothing in common.
[[nodiscard]] ContactRegion region_along(const ContactDirection& w, PlaneSetting setting,
                                         const ShapePlane& of_a, const ShapePlane& of_b,
                                         const ContactHeight* height, PredicateLadder& ladder);

/// A region of one point.
[[nodiscard]] ContactRegion point_region(const RegionVertex& point);

/// The face of a shape that is spanned by the corners of a support, as a loop counter-clockwise along w.
/// @param above the shape lies on the side w points to (it is A).
[[nodiscard]] std::vector<int> support_loop(const ConvexShape& shape, const std::vector<int>& support,
                                            const ContactDirection& w, bool above, PredicateLadder& ladder);

/// The common points of two shapes that cross: vertices of P n Q (two triangles: the ends of the segment).
/// @param heights of the two, complete if the ladder is floating.
[[nodiscard]] ContactRegion crossing_region(const ConvexShape& a, const ConvexShape& b,
                                            const PairHeights& heights, PredicateLadder& ladder);

}  // namespace ashlar
