// Separation and depth of two convex shapes, over the facets of D = P - Q.
//
// Every facet of D comes from a facet of P and a corner, edge or facet of Q, the reverse, or two edges that
// are not parallel. Seen from inside, its direction w (towards P) has the height min_P w.x - max_Q w.y. If
// some height is positive, P and Q are apart; if one is zero, the plane across w separates the two and
// contains points of both; if all are negative, the origin is inside D and the least |height| / |w| is the
// depth.
#pragma once

#include <vector>

#include "geometry/contact_type.hpp"
#include "geometry/convex/convex_shape.hpp"
#include "geometry/convex/plane_heights.hpp"
#include "geometry/exact/direction_predicates.hpp"

namespace ashlar {

/// The kinds of facets of D.
enum class EntranceKind {
  face_of_a,  ///< facet of A, support of B
  face_of_b,  ///< facet of B, support of A
  edge_edge,  ///< an edge of each
};

/// A facet of D by the features it is made of.
struct Entrance {
  EntranceKind kind = EntranceKind::face_of_a;
  int a = -1;             ///< facet or edge of A; -1 for face_of_b
  int b = -1;             ///< facet or edge of B; -1 for face_of_a
  bool reversed = false;  ///< w is the opposite of -N(a), N(b) or u(a) x v(b)

  friend bool operator==(const Entrance&, const Entrance&) = default;
};

/// Its exact direction from B to A.
[[nodiscard]] ContactDirection direction_of(const Entrance& entrance, const ConvexShape& a,
                                            const ConvexShape& b);

/// A direction of D's boundary with exact support of both shapes.
struct Support {
  Entrance entrance;
  ContactDirection w;
  std::vector<int> a, b;  ///< corners of A with the least, of B with the greatest w.x
};

/// Exact support of both shapes along any direction.
[[nodiscard]] Support support_along(const ConvexShape& a, const ConvexShape& b, ContactDirection w,
                                    PredicateLadder& ladder);

struct SeparationResult {
  /// Touching says that a plane separates the two and has points of both: they touch iff those have a common
  /// one; otherwise they are apart.
  Relation relation = Relation::crossing;
  /// Touching: the entrances of height zero, those with a facet if there are any, else edge pairs. Crossing
  /// solids: every entrance of least |height| / |w|, the first for each direction. Else empty (a triangle in
  /// space has no inside).
  std::vector<Support> supports;
};

/// For any two shapes; most useful where they are not clearly apart.
/// @param heights of the two; complete afterwards if they cross and the ladder is floating.
[[nodiscard]] SeparationResult find_separation(const ConvexShape& a, const ConvexShape& b,
                                               PairHeights& heights, PredicateLadder& ladder);

/// Every entrance of greatest height / |w| if that is not negative, one for each direction; else none.
[[nodiscard]] std::vector<Support> find_farthest_separation(const ConvexShape& a, const ConvexShape& b,
                                                            PredicateLadder& ladder);

/// The entrance that gives the direction of a contact, among equally near ones (DirectionRule).
[[nodiscard]] const Support& preferred_support(const std::vector<Support>& supports, const ConvexShape& a,
                                               const ConvexShape& b, PredicateLadder& ladder);

}  // namespace ashlar
