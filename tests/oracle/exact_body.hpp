// The solids and triangles of the oracle, in integers. All coordinates of a pair are multiplied by one power
// of two that makes them whole; from there on nothing is ever rounded. A body is kept both as its true
// vertices and edges and as its planes, found by comparing every triangle with every point: no mesh
// connectivity is used, so the oracle cannot share a mistake with code that walks a mesh.
#pragma once

#include <gmpxx.h>

#include <array>
#include <vector>

namespace ashlar::oracle {

using Point = std::array<double, 3>;
using IntegerVector = std::array<mpz_class, 3>;

/// One triangle (a flat body), or a closed convex solid of outward triangles.
struct Shape {
  std::vector<Point> points;
  std::vector<std::array<int, 3>> triangles;
};

/// normal . x <= offset for every x of the body it bounds.
struct Plane {
  IntegerVector normal;
  mpz_class offset;
};

/// A convex body whose coplanar triangles are one facet and whose collinear pieces are one edge.
struct ConvexBody {
  int dimension;                          ///< 3 solid, 2 triangle
  std::vector<IntegerVector> vertices;    ///< corners of the set, none on a straight edge or in a flat facet
  std::vector<int> source;                ///< (#vertices): index of each among the shape's points
  std::vector<std::array<int, 2>> edges;  ///< pairs of vertices
  std::vector<Plane> planes;              ///< solid: its facets; triangle: through its sides, upright on it
  std::vector<Plane> carrier_planes;      ///< triangle: the plane it lies in; solid: none
};

[[nodiscard]] mpz_class dot(const IntegerVector& a, const IntegerVector& b);
[[nodiscard]] IntegerVector cross(const IntegerVector& a, const IntegerVector& b);
[[nodiscard]] IntegerVector subtract(const IntegerVector& a, const IntegerVector& b);
[[nodiscard]] IntegerVector negated(const IntegerVector& a);
/// factor a + b
[[nodiscard]] IntegerVector scale_add(const mpz_class& factor, const IntegerVector& a,
                                      const IntegerVector& b);
[[nodiscard]] bool is_zero(const IntegerVector& a);
/// Divides by the greatest common divisor of the components; the direction is kept.
void make_primitive(IntegerVector& a);

/// The largest e for which every coordinate of both shapes is a whole multiple of 2^e (0 if all are zero).
[[nodiscard]] long common_exponent(const Shape& p, const Shape& q);

/// @param exponent coordinates are divided by 2^exponent and must then be whole.
/// @throws std::invalid_argument if a coordinate is not finite, the triangle has no area, or the triangles of
/// a solid are not all outward facets of the convex hull of the points.
[[nodiscard]] ConvexBody make_body(const Shape& shape, long exponent);

/// The body factor * body + shift. @param factor > 0.
[[nodiscard]] ConvexBody placed(const ConvexBody& body, const mpz_class& factor, const IntegerVector& shift);

/// (#facets): the true vertices of each facet of a convex solid as indices into shape.points,
/// counter-clockwise from outside.
[[nodiscard]] std::vector<std::vector<int>> facet_cycles(const Shape& solid);

}  // namespace ashlar::oracle
