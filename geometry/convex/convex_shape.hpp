// A convex solid, or a single triangle, as the set of its true corners, edges and facets.
//
// The representation of a body for exact contact classification. Coplanar triangles are one facet; a point on a
// straight edge or inside a flat facet is not a corner. All of it is decided exactly for the given doubles, so that
// two triangulations of the same solid give the same shape up to the numbering. A triangle is a flat shape: three
// corners, three edges, one facet seen from both sides.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "geometry/exact/direction_predicates.hpp"
#include "geometry/solid/polyhedron.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// A straight piece between two facets.
struct ConvexEdge {
  std::array<int, 2> corners;  ///< the left facet has it in this direction on its loop
  std::array<int, 2> facets;   ///< left and right facet; both 0 for a triangle
};

/// Constant after construction. Corners, edges and facets are numbered from 0.
class ConvexShape {
 public:
  /// @throws std::invalid_argument for collinear or non-finite points.
  [[nodiscard]] static ConvexShape from_triangle(const Vector3& a, const Vector3& b, const Vector3& c);

  /// The convex hull of a convex solid's points: the solid itself, or a placed copy of it whose faces
  /// rounding has tilted (Polyhedron::with_points). A facet's source triangle is one of the face it came
  /// from.
  /// @throws std::invalid_argument unless solid.convex().
  [[nodiscard]] static ConvexShape from_polyhedron(const Polyhedron& solid);

  /// The convex solid bounded by a closed, outward, connected mesh. A mesh that rounding has tilted (a
  /// rotated copy of an exact solid) may be concave by a few ulp at edges within its former facets: such
  /// edges are flipped, so the shape is the exact convex hull of the points and its edges between former
  /// facets stay.
  /// @throws std::invalid_argument if the mesh is not closed, is not finite, has a triangle of zero area, or
  /// is concave beyond repair by flips of edges.
  [[nodiscard]] static ConvexShape from_mesh(const TriangleMesh& mesh);

  /// As from_mesh, but a mesh that flips of edges do not repair is replaced by the hull of its points: for a placed
  /// copy of a convex solid, with points at any distance from their faces.
  /// @throws std::invalid_argument if the points are coplanar or not finite.
  [[nodiscard]] static ConvexShape hull_of(const TriangleMesh& mesh);

  [[nodiscard]] bool flat() const { return flat_; }
  /// (#corners), m.
  [[nodiscard]] const std::vector<Vector3>& corners() const { return corners_; }
  [[nodiscard]] const std::vector<ConvexEdge>& edges() const { return edges_; }
  [[nodiscard]] int facet_count() const { return static_cast<int>(facet_start_.size()) - 1; }
  /// Corners of a facet in order, counter-clockwise from outside (a triangle: as given); no three collinear.
  [[nodiscard]] std::span<const int> facet(int f) const {
    return {facet_corners_.data() + facet_start_[f], facet_corners_.data() + facet_start_[f + 1]};
  }
  /// Edges of a facet; edge k joins corners k and k + 1 of the loop.
  [[nodiscard]] std::span<const int> edges_of_facet(int f) const {
    return {facet_edges_.data() + facet_start_[f], facet_edges_.data() + facet_start_[f + 1]};
  }
  /// Facets around a corner, increasing.
  [[nodiscard]] std::span<const int> facets_of_corner(int v) const {
    return {corner_facets_.data() + corner_start_[v], corner_facets_.data() + corner_start_[v + 1]};
  }
  /// Index of the edge between two corners, or -1.
  [[nodiscard]] int find_edge(int v, int w) const;
  /// Index of the facet that has all of the given corners (at least three), or -1.
  [[nodiscard]] int find_facet(std::span<const int> corners) const;

  /// Index into the given points of each corner.
  [[nodiscard]] const std::vector<int>& source_points() const { return source_points_; }
  /// A given triangle each facet came from (of a flipped pair, either), or -1 where the mesh had to be
  /// replaced by its hull and no single face has the facet's corners.
  [[nodiscard]] const std::vector<int>& source_triangles() const { return source_triangles_; }
  [[nodiscard]] const NumericRange& range() const { return range_; }
  /// Outward normal of a facet (a triangle: by the right-hand rule), exact; valid while the shape lives.
  [[nodiscard]] ContactDirection facet_normal(int f) const;
  /// The floating numbers of facet_normal(f).
  [[nodiscard]] const DirectionNumbers& normal_numbers(int f) const { return normals_[f]; }
  /// |facet_normal(f)|^2.
  [[nodiscard]] const TrackedNumber& squared_normal(int f) const { return squared_normals_[f]; }
  /// Opposite corners of the axis-parallel box around the shape, m.
  [[nodiscard]] const Vector3& low() const { return low_; }
  [[nodiscard]] const Vector3& high() const { return high_; }

 private:
  void index();
  void index_facets_of_corners();

  bool flat_ = false;
  std::vector<Vector3> corners_;
  std::vector<ConvexEdge> edges_;
  std::vector<int> facet_start_, facet_corners_, facet_edges_;
  std::vector<int> corner_start_, corner_facets_;
  std::vector<int> source_points_, source_triangles_;
  std::vector<DirectionNumbers> normals_;
  std::vector<TrackedNumber> squared_normals_;
  Vector3 low_, high_;
  NumericRange range_;
};

}  // namespace ashlar
