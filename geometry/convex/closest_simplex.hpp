// The point of P - Q nearest to the origin, exactly.
//
// Gilbert, Johnson and Keerthi's iteration on D = P - Q, twice: in plain floating point for a guess, which
// decides nothing, then with exact signs from there. The exact pass ends when no corner of P or Q lies beyond
// the last simplex along w, which certifies the optimum whatever the guess was; each of its steps strictly
// shortens w, so it ends for every input.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/convex/convex_shape.hpp"
#include "geometry/exact/direction_predicates.hpp"

namespace ashlar {

/// A corner of D: corner a of P minus corner b of Q.
struct CornerPair {
  int a, b;
};

/// Up to four corners of D, affinely independent, whose hull has the nearest point in its relative interior.
struct CornerSimplex {
  std::array<CornerPair, 4> pairs;
  int size = 0;

  void add(CornerPair p) { pairs[size++] = p; }
};

struct ClosestSimplex {
  bool contains_origin = false;  ///< P and Q intersect: w is meaningless
  bool interior = false;         ///< the origin is an inner point of a tetrahedron of D: they cross
  CornerSimplex simplex;
  ContactDirection w;  ///< exact direction of p - q at a closest pair
  /// Corners of P with the least, of Q with the greatest w . x: the faces w is normal to.
  std::vector<int> support_a, support_b;
};

/// Floating guess of the simplex for the corners of two convex sets; any answer is allowed.
[[nodiscard]] CornerSimplex guess_closest_simplex(std::span<const Vector3> a, std::span<const Vector3> b);

[[nodiscard]] ClosestSimplex find_closest_simplex(const ConvexShape& a, const ConvexShape& b,
                                                  const CornerSimplex& guess, PredicateLadder& ladder);

/// Corners of a shape with the least (orientation 1) or greatest (-1) w . x, increasing, by exact signs.
[[nodiscard]] std::vector<int> support_corners(const ConvexShape& shape, const ContactDirection& w,
                                               int orientation, PredicateLadder& ladder);

}  // namespace ashlar
