#include "geometry/solid/rounded_convexity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/exact/direction_predicates.hpp"
#include "geometry/exact/rounding_mode.hpp"

namespace ashlar {

namespace {

// The third point of the triangle of a face that has the edge from -> to as a side; -1 if there is none.
int apex_over(const Polyhedron& solid, int face, int from, int to) {
  for (const int t : solid.faces()[face].triangles) {
    const auto& c = solid.mesh().triangles[t];
    for (int k = 0; k < 3; ++k)
      if (c[k] == from && c[(k + 1) % 3] == to) return c[(k + 2) % 3];
  }
  return -1;
}

[[gnu::noinline]] bool convex_rounding_to_nearest(const Polyhedron& solid) {
  const std::vector<Vector3>& x = solid.mesh().points;
  NumericRange range;
  double greatest = 0.0;
  for (const Vector3& p : x) {
    for (int i = 0; i < 3; ++i) range.include(p[i]);
    greatest = std::max(greatest, p.cwiseAbs().maxCoeff());
  }
  const double unit = std::nextafter(greatest, std::numeric_limits<double>::infinity()) - greatest;
  const double deepest = rounding_dent_units * unit;
  range.include(deepest);
  PredicateLadder ladder;
  ladder.open(range);
  return std::all_of(solid.edges().begin(), solid.edges().end(), [&](const PolyhedronEdge& edge) {
    if (edge.convex) return true;
    const auto [from, to] = edge.vertices;
    const int left = apex_over(solid, edge.faces[0], from, to);
    const int right = apex_over(solid, edge.faces[1], to, from);
    if (left < 0 || right < 0) return false;
    const ContactDirection w = ContactDirection::cross({&x[to], &x[from]}, {&x[right], &x[left]});
    return !is_zero(w, ladder) && is_within(w, {&x[left], &x[from]}, deepest, false, ladder);
  });
}

}  // namespace

bool is_convex_but_for_rounding(const Polyhedron& solid) {
  const NearestRounding nearest;
  return convex_rounding_to_nearest(solid);
}

}  // namespace ashlar
