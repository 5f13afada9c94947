// The corners, edges and faces of a solid that need not be convex, with the directions of the solid from each.
//
// Normal cones. Near an inner point p of a feature the solid is p + T with a polyhedral cone T, the same for
// all these points. Moving from p by u in T changes the distance to a point p - w by the sign of w . u at
// first order, so p is nearest among the points near it iff
//   w . u >= 0 for all u in T:  w is in the normal cone of the feature.
// - face: w = -s n, s >= 0, n the outward normal;
// - edge: w is across it and w . m >= 0 for the inward directions m in both faces; a reflex edge
//   admits only w = 0, for T then contains a line across it;
// - corner: w . e >= 0 for all sides e of triangles at it. The surface then is on the side w points to, and the
//   other side is
//   completely inside T or completely outside. Around the ray of the surface nearest to -w the solid has less than
//     half of the
//   space in the second case (a convex edge, or a face with n . w < 0), more than half in the first one. Only
//     saddle corners,
//   with edges of both kinds, need this check.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "geometry/convex/contact_region.hpp"
#include "geometry/exact/direction_predicates.hpp"
#include "geometry/exact/rational_vector.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// A merged edge with the data of its normal cone.
struct SolidEdge {
  int from, to;               ///< points of the mesh
  int left_apex, right_apex;  ///< points of the mesh, in the left and right face, off the edge
  bool convex;
};

/// A side of a face: the face is at the left, seen from outside.
struct SolidSide {
  int from, to;  ///< points of the mesh
  int edge;
};

enum class CornerKind {
  convex,  ///< all edges convex
  reflex,  ///< all edges reflex: only w = 0 is in the normal cone
  saddle,
};

/// Refers to the solid. Constant after construction.
class SolidFeatures {
 public:
  explicit SolidFeatures(const Polyhedron& solid);

  [[nodiscard]] const Polyhedron& solid() const { return solid_; }
  [[nodiscard]] const Vector3& point(int v) const { return solid_.mesh().points[v]; }
  [[nodiscard]] const std::vector<SolidEdge>& edges() const { return edges_; }
  [[nodiscard]] const std::vector<SolidSide>& sides(int face) const { return sides_[face]; }
  /// Three points of a face, counter-clockwise from outside.
  [[nodiscard]] const std::array<int, 3>& triangle_of_face(int face) const {
    return solid_.mesh().triangles[solid_.faces()[face].triangles[0]];
  }

  /// The feature that has a point of the mesh in its relative interior: corner (index: the point), edge or
  /// face. @param triangle one that has the point.
  [[nodiscard]] ContactFeature feature_of_point(int v, int triangle) const;
  /// The edge or face that has a side of a triangle.
  [[nodiscard]] ContactFeature feature_of_side(int from, int to, int triangle) const;
  /// @param v a corner.
  [[nodiscard]] CornerKind corner_kind(int v) const { return corner_kind_[v]; }

  /// Triangles around a point of the mesh.
  [[nodiscard]] std::vector<int> triangles_at(int v) const;

  /// True if sign * w . m >= 0 for both inward directions of an edge; w is across the edge.
  [[nodiscard]] bool admits(const SolidEdge& edge, const ContactDirection& w, int sign,
                            PredicateLadder& ladder) const;
  /// True if sign * w . e >= 0 for all rays of a corner: necessary for all, sufficient for convex corners.
  [[nodiscard]] bool rays_admit(int corner, const ContactDirection& w, int sign,
                                PredicateLadder& ladder) const;
  /// The other half, for a w that the rays admit. @param w not zero.
  [[nodiscard]] bool lies_on_side_of(int corner, const RationalVector& w) const;
  /// The same for w from a point to the corner, with a filter. @param floating as in PredicateLadder.
  [[nodiscard]] bool lies_beyond(int corner, const Vector3& from, bool floating) const;

 private:
  struct Ray {
    int to;
    int triangle;  // at its left
    int edge;      // that has it, or -1 within a face
  };
  static std::uint64_t key(int from, int to) {
    return (static_cast<std::uint64_t>(from) << 32U) | static_cast<std::uint32_t>(to);
  }
  [[nodiscard]] int face(int triangle) const { return solid_.face_of_triangle()[triangle]; }
  [[nodiscard]] bool is_sharp(int from, int to) const {
    return face(triangle_left_of_.at(key(from, to))) != face(triangle_left_of_.at(key(to, from)));
  }
  [[nodiscard]] int apex(int from, int to) const;
  [[nodiscard]] int next_sharp(int previous, int v) const;
  void follow(int from, int first, const std::unordered_map<std::uint64_t, int>& edge_between);
  void classify_corners();
  [[nodiscard]] bool lies_on_side_of(const Ray& lowest, const RationalVector& w) const;

  const Polyhedron& solid_;
  std::vector<SolidEdge> edges_;
  std::vector<std::vector<SolidSide>> sides_;                // by face
  std::unordered_map<std::uint64_t, int> triangle_left_of_;  // by side
  std::unordered_map<std::uint64_t, int> edge_of_side_;
  std::vector<int> edge_of_point_;  // by point: -1 unless inside an edge
  std::vector<CornerKind> corner_kind_;
  std::vector<int> ray_start_;  // by point
  std::vector<Ray> rays_;
};

}  // namespace ashlar
