// The current shape of a block's surface: data used several times by a contact search.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geometry/boxes/box.hpp"
#include "geometry/boxes/box_tree.hpp"
#include "geometry/exact/direction_predicates.hpp"
#include "geometry/subfaces/sub_face_refinement.hpp"
#include "geometry/subfaces/sub_face_surface.hpp"

namespace ashlar {

/// Constant after construction.
class PlacedSurface {
 public:
  /// Coordinates are rounded to multiples of 2^-70 of the largest one: far below its last place, it keeps
  /// numbers that are nearly zero from needing multiple precision in every predicate.
  /// @param surface must outlive this. @param points (#surface.points), current positions, m
  /// @param shapes (#surface.cells) true shapes of cells that curve; empty: the cells are flat
  PlacedSurface(const SubFaceSurface& surface, std::vector<Vector3> points,
                std::span<const CellShape> shapes = {});

  [[nodiscard]] const SubFaceSurface& surface() const { return *surface_; }
  [[nodiscard]] const std::vector<Vector3>& points() const { return points_; }
  [[nodiscard]] const Vector3& point(int index) const { return points_[static_cast<std::size_t>(index)]; }
  /// Outward unit normal of a cell (of its area vector; zero if the cell has collapsed).
  [[nodiscard]] const Vector3& normal(int cell) const { return normals_[static_cast<std::size_t>(cell)]; }
  /// Contains the true cell.
  [[nodiscard]] const Box& cell_box(int cell) const { return cell_boxes_[static_cast<std::size_t>(cell)]; }
  /// True if searches of cells by a tree pay.
  [[nodiscard]] bool has_many_cells() const { return tree_ != nullptr; }
  /// Of the boxes of cells, if there are many.
  [[nodiscard]] const BoxTree& cell_tree() const;
  /// Upper bound of the distance of the true cell from the flat one, m.
  [[nodiscard]] double chord_bound(int cell) const {
    return chord_bounds_.empty() ? 0.0 : chord_bounds_[static_cast<std::size_t>(cell)];
  }
  /// Largest of chord_bound, m.
  [[nodiscard]] double largest_chord_bound() const { return largest_chord_bound_; }
  /// Contains the true surface.
  [[nodiscard]] const Box& box() const { return box_; }
  [[nodiscard]] std::vector<Vector3> corners(int cell) const;
  [[nodiscard]] std::array<Vector3, 2> edge(int index) const;
  /// Largest distance of a point from the first one, m: invariant under translation and rotation of the block.
  [[nodiscard]] double size() const { return size_; }
  /// Exponents of the coordinates of all points.
  [[nodiscard]] const NumericRange& range() const { return range_; }

 private:
  struct CellTree;

  const SubFaceSurface* surface_;
  std::vector<Vector3> points_;
  std::vector<Vector3> normals_;
  std::vector<Box> cell_boxes_;
  std::shared_ptr<CellTree> tree_;  ///< of many cell_boxes_, made when it is first asked
  std::vector<double> chord_bounds_;
  double largest_chord_bound_ = 0.0;
  Box box_;
  double size_ = 0.0;
  NumericRange range_;
};

/// A vector with its components rounded to multiples of 2^-70 of the largest one (0 stays 0).
[[nodiscard]] Vector3 without_tiny_parts(const Vector3& vector);

}  // namespace ashlar
