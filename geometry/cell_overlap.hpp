// Overlap of two flat convex cells seen along one direction (theory.md section 6.4, face-face).
#pragma once

#include <span>
#include <vector>

#include "geometry/projected_orientation.hpp"

namespace ashlar {

/// How a corner of an overlap polygon came about.
enum class OverlapCornerKind {
  vertex_of_a,  ///< a vertex of a inside b or on its outline
  vertex_of_b,  ///< a vertex of b inside a or on its outline, and not on a vertex of a
  crossing,     ///< two sides crossing in inner points of both
};

/// A corner of the overlap polygon.
struct OverlapCorner {
  OverlapCornerKind kind;
  int index_a;            ///< vertex of a, or side of a from this vertex to the next; -1 for vertex_of_b
  int index_b;            ///< likewise for b; -1 for vertex_of_a
  Eigen::Vector2d place;  ///< in the frame's plane, m (rounded; the kind and indices are exact)
};

/// A plane across the direction of sight: place (s, t) stands for the line origin + s e1 + t e2 + any
/// multiple of w.
struct ViewFrame {
  Vector3 origin;
  Vector3 e1;
  Vector3 e2;
  Vector3 w;  ///< unit; e1, e2, w is a right-handed orthonormal frame

  /// @param direction not zero, any length
  ViewFrame(const Vector3& origin, const Vector3& direction);
  [[nodiscard]] Eigen::Vector2d project(const Vector3& point) const;
};

/// Corners of the overlap in counter-clockwise order seen against w: each exactly once, none missing, none
/// outside. Which corners there are is decided exactly on the given doubles.
/// @param a clockwise seen against frame.w, b counter-clockwise (they face each other), each convex with >= 3
/// vertices
/// @return fewer than 3 corners if the overlap has no area (apart, or touching in a point or a segment)
[[nodiscard]] std::vector<OverlapCorner> overlap_polygon(std::span<const Vector3> a,
                                                         std::span<const Vector3> b, const ViewFrame& frame,
                                                         PredicateCounts& counts);

}  // namespace ashlar
