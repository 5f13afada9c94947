// Contact points on the overlap of two faces: mapping from places in the projection plane to the material of both
// blocks and back.
//
// Faces that may curve are searched as triangles. In an undivided rectangle the diagonal is a property of the mesh:
// the mirrored scene has the other one. Springs must not depend on it. So such faces overlap as whole polygons, and
// material points are the projections of places onto the true surface.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/index.hpp"
#include "mechanics/contact/contact_points.hpp"

namespace ashlar {

/// @param cell index into the cells of the body's surface
[[nodiscard]] inline const SurfaceCell& cell_of(const ContactBody& body, int cell) {
  return body.placed->surface().cells[at(cell)];
}

/// @param point index into the points of the body's surface. @return its place in the reference configuration
[[nodiscard]] inline const Vector3& reference_point(const ContactBody& body, int point) {
  return body.placed->surface().points[at(point)];
}

/// The affine map from projected places to reference points of a flat cell.
class CellMap {
 public:
  CellMap(const ContactBody& body, int cell, const ViewFrame& frame);
  [[nodiscard]] Vector3 reference(const Eigen::Vector2d& place) const {
    return reference_ + reference_slope_ * (place - first_);
  }
  [[nodiscard]] Vector3 placed(const Eigen::Vector2d& place) const {
    return placed_ + placed_slope_ * (place - first_);
  }
  /// Projected place of the point of the cell's plane closest to a reference point.
  [[nodiscard]] Eigen::Vector2d place(const Vector3& reference) const;

 private:
  Eigen::Vector2d first_;
  Vector3 reference_;
  Vector3 placed_;
  Eigen::Matrix<double, 3, 2> reference_slope_;
  Eigen::Matrix<double, 3, 2> placed_slope_;
};

/// Makes the gap of a point of a face relative to the initial placement of its material points.
/// @param known initial overlap of the blocks, m, >= 0; 0: the gap is unchanged
void count_from_placement(const ContactBody& a, const ContactBody& b, bool master_is_a, double known,
                          ContactPoint& point);
/// The same for a point of two crossed edges.
void count_from_placement_of_edges(const ContactBody& a, const ContactBody& b, double known,
                                   ContactPoint& point);

/// True if points are at their places in the material: not on flat sub-faces of a block that bends.
[[nodiscard]] bool has_true_places(const ContactBody& a, const ContactBody& b, bool curved);

/// Overlaps of cells that form one polygon: those of two whole faces, or a single one.
struct JoinedOverlap {
  std::vector<std::size_t> cells;  ///< indices into the list of overlaps, at least one
  bool whole = false;              ///< of two whole faces with several cells
};

/// In the order of the first of their cells. Overlaps of convex faces whose cells are the triangles of the mesh are
/// joined, unless each face has one cell. @param curved false: none are joined
[[nodiscard]] std::vector<JoinedOverlap> join_whole_faces(const ContactBody& a, const ContactBody& b,
                                                          const std::vector<CellOverlap>& overlaps,
                                                          bool curved);

/// Makes the contact points of two cells, or of two whole faces, that face each other. The arguments of the
/// constructor must outlive it.
class OverlapPoints {
 public:
  /// @param cells of the points; for whole faces one of each
  OverlapPoints(const ContactBody& a, const ContactBody& b, const CellOverlap& cells, bool whole,
                bool master_is_a, const ContactPointSettings& settings);

  /// Projection against w of the frame, counter-clockwise; fewer than 3 corners if there is no overlap.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& polygon() const { return polygon_; }
  /// @param place in the polygon
  [[nodiscard]] ContactPoint at_place(const Eigen::Vector2d& place, double area) const;
  /// Reference point of a or of b projected to a place, also outside of the polygon. For whole faces that curve it is
  /// in the tangent plane at the centre.
  [[nodiscard]] Vector3 reference(bool of_a, const Eigen::Vector2d& place) const;
  /// The inverse of reference().
  [[nodiscard]] Eigen::Vector2d place(bool of_a, const Vector3& reference) const;

 private:
  /// Linearised inverse projection near a place.
  struct Tangent {
    Vector3 reference = Vector3::Zero();
    Eigen::Matrix<double, 3, 2> slope = Eigen::Matrix<double, 3, 2>::Zero();  ///< d reference / d place
  };
  [[nodiscard]] const ContactBody& body(bool of_a) const { return of_a ? a_ : b_; }
  [[nodiscard]] int cell(bool of_a) const { return of_a ? cells_.cell_a : cells_.cell_b; }
  [[nodiscard]] const CellMap& map(bool of_a) const { return of_a ? map_a_ : map_b_; }
  /// True if points on the block's true surface are computed.
  [[nodiscard]] bool follows(bool of_a) const { return whole_ && !is_affine(*body(of_a).model); }
  /// The point of the true surface projected to a place, by Newton's method in the face's plane.
  [[nodiscard]] Tangent seen_at(bool of_a, const Eigen::Vector2d& place, const Vector3& start) const;

  const ContactBody& a_;
  const ContactBody& b_;
  const CellOverlap& cells_;
  bool whole_;
  bool master_is_a_;
  bool curved_;
  double known_overlap_;
  ViewFrame frame_;
  CellMap map_a_;
  CellMap map_b_;
  std::vector<Eigen::Vector2d> polygon_;
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero();  ///< of the polygon's corners
  Tangent tangent_a_;                                 ///< at the centre, for whole faces that curve
  Tangent tangent_b_;
};

}  // namespace ashlar
