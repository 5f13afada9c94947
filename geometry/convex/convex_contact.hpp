// The exact contact of two convex solids or triangles: relation, type, region, distance, depth.
//
//   d = min |p - q|,  w = p - q at a closest pair,  K = P n (Q + w)
// P and Q intersect: d = 0; with common inner points they cross, otherwise they touch in K = P n Q. The type
// is the pair of dimensions of the faces that carry K on P and K - w on Q (contact_type.hpp). Nothing is
// decided on a rounded number and there is no tolerance: every sign comes from the ladder of
// direction_predicates.hpp. Answers do not depend on the rounding mode of the caller.
#pragma once

#include <optional>
#include <vector>

#include "geometry/contact_type.hpp"
#include "geometry/convex/contact_region.hpp"
#include "geometry/convex/convex_shape.hpp"
#include "geometry/convex/separating_direction.hpp"

namespace ashlar {

/// Rule that determined the direction of a contact.
enum class DirectionRule {
  closest_points,     ///< apart: w
  unique,             ///< touching in a face or in crossing edges: the only normal
  history,            ///< the facet of D = P - Q the caller saw last with a positive gap
  least_penetration,  ///< no history: the facet of D nearest to the origin
  /// Several facets of D are equally near; chosen: one with a facet of A or B before two edges, then the
  /// direction that is nearest to the difference of the means of the corners, then the lowest index (A
  /// first).
  least_penetration_tie,
};

/// A way to end a crossing: a translation of A of least length, and the contact it leads to.
struct MinimalTranslation {
  Entrance entrance;
  Vector3 translation;   ///< of A, m, correctly rounded
  ContactRegion region;  ///< points on A before, on B after the translation (B does not move)
};

/// The whole report.
struct ConvexContact {
  Relation relation = Relation::apart;
  ContactRegion region;           ///< with type and carriers; crossing: the common solid
  double squared_distance = 0.0;  ///< m^2, correctly rounded
  /// Distance, or minus the depth of crossing solids, m, correctly rounded; only with CrossingDetail::gap.
  double gap = 0.0;
  Vector3 displacement;  ///< w, m, correctly rounded; zero unless apart
  /// Unit normal from B to A, correctly rounded: w / |w|, the contact normal, or the direction the rule
  /// chose; zero for two triangles that cross.
  Vector3 normal;
  DirectionRule rule = DirectionRule::closest_points;
  /// The facet of D the normal belongs to; none where the normal is that of closest points.
  std::optional<Entrance> entrance;
  double squared_depth = 0.0;                            ///< crossing solids: m^2, correctly rounded
  std::vector<MinimalTranslation> minimal_translations;  ///< crossing solids: all of least length
  DecisionCounts decided_by;

  [[nodiscard]] ContactType type() const { return region.type; }
};

/// Optional results besides relation, type and squared lengths.
struct CrossingDetail {
  bool region = true;               ///< the vertices of the common solid
  bool translation_regions = true;  ///< the contacts the minimal translations lead to
  bool gap = false;                 ///< ConvexContact::gap, of any pair
};

/// Exact type and report. @param history a facet of D the pair was last seen apart across, used where the
/// contact does not fix its own normal (V-V, V-E, collinear E-E at distance zero, crossing), as long as the
/// two features of that facet still face each other along its direction.
[[nodiscard]] ConvexContact classify(const ConvexShape& a, const ConvexShape& b,
                                     const std::optional<Entrance>& history = std::nullopt,
                                     const CrossingDetail& detail = {});

/// Distance to a common plane up to which features count as one contact; an input of the scene, without default.
struct Resolution {
  double distance = 0.0;  ///< m, >= 0: tau
  double sine = 0.0;      ///< of the contact angle, 0 to 1
};

/// The type at a resolution, for the contact report. A step uses resolution zero.
///
/// With w the direction of the exact contact (touching, crossing: chosen as in classify), P_tau is the convex
/// hull of the corners of P that are at most `distance` above its support along w, or seen from every support
/// corner at an inclination of at most the contact angle; Q_tau likewise from below; both projected along w.
/// The region is the common part of these plane sets. Every comparison is exact. At resolution zero this is
/// classify(); dimensions of carriers never decrease as the resolution grows.
struct ResolvedContact {
  Relation relation = Relation::apart;
  /// Carriers are faces of the plane sets; index -1 where such a face is not one of the shape. A point of the
  /// other shape's corner (pairs V-F, V-E) is in the support plane across w.
  ContactRegion region;
  Vector3 normal;    ///< unit, from B to A, correctly rounded; zero for triangles that cross without history
  double gap = 0.0;  ///< min_A n.x - max_B n.y, m: negative where they cross; correctly rounded
  DirectionRule rule = DirectionRule::closest_points;
  std::optional<Entrance> entrance;
  Resolution resolution;  ///< as given
  DecisionCounts decided_by;
};

/// @throws std::invalid_argument for a negative or non-finite resolution, or a sine above 1.
[[nodiscard]] ResolvedContact classify_at(const ConvexShape& a, const ConvexShape& b,
                                          const Resolution& resolution,
                                          const std::optional<Entrance>& history = std::nullopt);

/// The facet of D = P - Q with the largest separation of the two (of several the known one, else as in
/// DirectionRule): the history for later steps while the two are apart or just touch. Empty if they cross.
[[nodiscard]] std::optional<Entrance> find_entrance(const ConvexShape& a, const ConvexShape& b,
                                                    const std::optional<Entrance>& history = std::nullopt);

}  // namespace ashlar
