// The answers of record for two convex solids or two triangles, straight from the definition: squared
// distance, region, carriers, type, depth, all rational and never rounded. Slow and plain on purpose; shares
// nothing with the code it checks.
//
//   K = P n (Q + w), w = p - q at a closest pair; type = dimensions of the carriers of K on P and Q
#pragma once

#include <string>
#include <vector>

#include "oracle/exact_body.hpp"

namespace ashlar::oracle {

using RationalVector = std::array<mpq_class, 3>;

/// A vertex of the region.
struct RegionPoint {
  RationalVector on_p;
  RationalVector on_q;  ///< on_p - w
  int p_dimension;      ///< of the carrier of this point on P: 0 vertex, 1 edge, 2 facet, 3 the solid
  int q_dimension;
};

/// The contact that a pair has (translation zero) or has after P was moved by `translation`.
struct ExactContact {
  bool intersecting;  ///< squared distance is zero
  bool crossing;      ///< interiors meet
  int p_dimension;    ///< of the carrier of the region on P
  int q_dimension;
  int region_dimension;
  std::vector<int> p_carrier;  ///< corners of the carrier, indices into the shape's points, increasing
  std::vector<int> q_carrier;
  RationalVector w;
  mpq_class squared_distance;
  std::vector<RegionPoint> region;  ///< increasing (x, then y, then z) on P, in P's place before any move
  RationalVector translation;
};

/// The full answer. Depth is given for crossing solids only.
struct ExactAnswer {
  ExactContact contact;
  mpq_class squared_depth;
  std::vector<ExactContact>
      minimal_translations;  ///< one for each nearest facet of P - Q, in increasing order
};

/// @throws std::invalid_argument: see make_body.
[[nodiscard]] ExactAnswer classify_exactly(const Shape& p, const Shape& q);

/// "V-V" ... "F-F" or "crossing".
[[nodiscard]] std::string type_name(const ExactContact& contact);

/// Every direction n, primitive, in which P lies in n . x >= c and Q in n . x <= c for some c, among the
/// normals that the facets of P - Q can have. Not empty for bodies that touch; empty for solids that cross.
[[nodiscard]] std::vector<RationalVector> separating_normals(const Shape& p, const Shape& q);

/// Nearest double, ties to even, subnormal numbers included.
[[nodiscard]] double round_to_double(const mpq_class& value);
/// The double nearest to x / sqrt(squared), squared > 0: a component of a unit vector.
[[nodiscard]] double round_quotient_by_root(const mpq_class& x, const mpq_class& squared);

}  // namespace ashlar::oracle
