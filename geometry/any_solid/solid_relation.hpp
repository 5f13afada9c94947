// Exact relation and distance of two solids that need not be convex.
//
// The distance is that of the nearest triangles. Where the boundaries have no common point, one solid is
// inside the other or they are apart; one point of each decides. Where they have, the interiors meet iff they
// do near some common point: a part of A's boundary inside B, if it is not all of it, ends at such a point.
// Every pair of merged features with a common inner point is carried by touching triangles, which name it,
// and its cones decide (touching_features.hpp). A connected part of the boundary of one cone that is inside
// the other cone ends at a common ray, so looking at all pairs of features is enough.
#pragma once

#include "geometry/any_solid/solid_features.hpp"
#include "geometry/contact_type.hpp"
#include "geometry/exact/direction_predicates.hpp"

namespace ashlar {

struct SolidRelation {
  Relation relation = Relation::apart;
  double squared_distance = 0.0;  ///< m^2, correctly rounded
  DecisionCounts decided_by;
};

[[nodiscard]] SolidRelation relate_solids(const SolidFeatures& a, const SolidFeatures& b);

}  // namespace ashlar
