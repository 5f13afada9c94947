// All local minima of the distance between two solids that need not be convex.
//
// A pair (p, q) is a local minimum if no points of the solids near p and q are nearer to each other. With
// w = p - q and the normal cones of solid_features.hpp this is so iff
//   w is in the normal cone of the feature of A that has p in its relative interior, -w in that of B's.
// For a pair of features (f, g) there is one w only: the shortest vector between the flats that carry them.
// Their common part is
//   K(f, g) = closure of { p in the inner of f : p - w in the inner of g },
// a point, segments or polygons. A pair with points and a w in both cones is a contact, unless K(f, g) is in
// the closure of that of a pair of higher features, which has the same w. Where solids touch w = 0 is in
// every cone: every common point is a minimum. What lies between p and q is not looked at: a minimum
// through a thin wall is one.
//
// Pairs are found by boxes, decided by exact signs (filter, then exact), and constructed in rational numbers.
// Only sources of this layer include this file.
#pragma once

#include <optional>
#include <vector>

#include "geometry/any_solid/face_polygon_overlap.hpp"
#include "geometry/any_solid/solid_features.hpp"

namespace ashlar {

/// Selection of minima.
struct MinimumBound {
  /// m: largest distance (exact), if given; else only minima whose squared distance rounds to least_squared.
  std::optional<double> distance;
  double least_squared = 0.0;  ///< m^2
  bool touching = false;       ///< the solids touch: without a distance, minima with w = 0 only
};

struct MinimumPoint {
  ContactFeature a, b;  ///< carriers
  RationalVector on_a;  ///< on_b = on_a - w
};

struct DistanceMinimum {
  ContactFeature a, b;  ///< corner (index: the point of the mesh), edge or face
  RationalVector w;     ///< from B to A
  /// Direction from B to A, of any length; zero if w = 0 and the features do not fix it (V-V, V-E, collinear
  /// edges).
  RationalVector normal;
  int dimension = 0;      ///< of K
  Rational squared_area;  ///< m^4
  /// The point; both ends of each segment; or the vertices of the polygons, each once.
  std::vector<MinimumPoint> points;
};

/// @param a,b solids without common inner points. @return in no particular order of distance, sorted by the
/// dimensions and numbers of the features.
[[nodiscard]] std::vector<DistanceMinimum> find_distance_minima(const SolidFeatures& a,
                                                                const SolidFeatures& b,
                                                                const MinimumBound& bound,
                                                                DecisionCounts& counts);

}  // namespace ashlar
