// Quadrature on segments, triangles and convex polygons.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Points in [0, 1] with positive weights.
struct SegmentRule {
  std::vector<double> points;
  std::vector<double> weights;
};

/// Gauss-Legendre on [0, 1], weights of sum 1, exact to degree 2 count - 1. @param count 1 to 64
[[nodiscard]] SegmentRule gauss_legendre(int count);

/// Gauss-Lobatto on [0, 1] (both ends included), weights of sum 1, exact to degree 2 count - 3. @param count
/// 2 to 64
[[nodiscard]] SegmentRule gauss_lobatto(int count);

/// Integrates f(u) (1 - u) over [0, 1] with u = 0 included (Gauss-Radau for the Jacobi weight), weights of
/// sum 1/2, exact to degree 2 count - 2. @param count 1 to 64
[[nodiscard]] SegmentRule radau_for_triangles(int count);

/// Points of a convex polygon in the plane with weights that sum to its area.
struct PolygonRule {
  std::vector<Eigen::Vector2d> points;
  std::vector<double> weights;  ///< positive
};

/// A rule for a convex polygon with points on its outline, including its corners: a contact that tilts onto one edge
/// or corner is detected at once. The polygon is cut into triangles from its centroid. Each is mapped from a square
/// with Lobatto points along the outline and Radau points towards the centroid. Points on shared cuts are merged.
/// Nearly straight corners (lower than a thousandth of the distance between their neighbours) are cut off first, as
/// triangles with inner points: the crossing of two almost coincident edges is ill-conditioned, and must not divide a
/// large part.
/// @param polygon (#corners >= 3, 2), counter-clockwise, convex but for rounding. If its area is within rounding
/// error (1e-13 of the squared length), the rule may be empty; zero area gives an empty rule
/// @param degree polynomials integrated exactly, 1 to 60
[[nodiscard]] PolygonRule polygon_rule(const std::vector<Eigen::Vector2d>& polygon, int degree);

/// A rule for products of two affine functions, exact to degree 2, with the corners of a convex polygon of n corners.
/// It has two rings of n points, the corners and their images nearer to the centroid, and two more points unless
/// these integrate the second moment (as in triangles and parallelograms): 2 n or 2 n + 2 points, none at the
/// centroid (notes/affine_rule.md). Nearly straight corners are treated as in polygon_rule().
/// @param polygon as in polygon_rule()
[[nodiscard]] PolygonRule affine_rule(const std::vector<Eigen::Vector2d>& polygon);

/// Barycentric points of a triangle with weights of sum 1, exact to a degree (collapsed Gauss-Legendre,
/// interior).
struct TriangleRule {
  std::vector<Vector3> barycentric;
  std::vector<double> weights;
};
[[nodiscard]] TriangleRule triangle_rule(int degree);

/// Points (m) with weights (m^3) that integrate polynomials of a degree exactly over the interior of a closed
/// surface. Made of signed tetrahedra from one point: points of a nonconvex solid may lie outside it, and weights may
/// be negative.
struct VolumeRule {
  std::vector<Vector3> points;
  std::vector<double> weights;
};
/// @param mesh closed, outward triangles. @param apex of the tetrahedra, near the solid. @param degree 0 to
/// 100
[[nodiscard]] VolumeRule volume_rule(const TriangleMesh& mesh, const Vector3& apex, int degree);

}  // namespace ashlar
