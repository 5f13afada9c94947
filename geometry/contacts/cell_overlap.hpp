// The overlap of two flat cells that face each other: a plane set each, seen along the mean of their normals.
#pragma once

#include <optional>
#include <vector>

#include "geometry/convex/overlap_polygon.hpp"
#include "geometry/subfaces/placed_surface.hpp"
#include "geometry/subfaces/view_frame.hpp"

namespace ashlar {

/// A corner of an overlap polygon: where it lies in both cells (corner or side by the cell's own numbering).
/// Which corners there are and what they are made of is exact for the given doubles; the place is rounded.
struct OverlapCorner {
  PlaneLocation in_a;
  PlaneLocation in_b;
  Eigen::Vector2d place;  ///< in the frame's plane, m
};

/// Two cells whose faces face each other.
struct CellOverlap {
  int cell_a;
  int cell_b;
  ViewFrame frame;                     ///< w is the mean direction of the two normals, out of b
  std::vector<OverlapCorner> corners;  ///< at least 3, counter-clockwise seen against w, each once
  std::vector<double> gaps;            ///< of the flat cells at each corner along w, m
};

/// The overlap of two cells; none if it has no area.
/// @pre rounding to nearest, the normals face each other
[[nodiscard]] std::optional<CellOverlap> overlap_of_cells(const PlacedSurface& a, int cell_a,
                                                          const PlacedSurface& b, int cell_b,
                                                          DecisionCounts& counts);

/// Whether a point of another surface is over a cell or on its rim, seen along the cell's normal.
/// @pre rounding to nearest
[[nodiscard]] bool is_over_cell(const PlacedSurface& with_point, const Vector3& point, const PlacedSurface& s,
                                int cell, DecisionCounts& counts);

/// Where a point is seen along a cell's normal.
struct PlaceOverCell {
  bool over = false;      ///< over it, on its rim, or beyond none but edges of its face
  std::vector<int> past;  ///< sides that it is beyond, all of them edges of the face
};
/// @param past_convex whether it may be beyond convex edges, or only beyond reflex ones
/// @pre rounding to nearest
[[nodiscard]] PlaceOverCell place_over_cell(const PlacedSurface& with_point, const Vector3& point,
                                            const PlacedSurface& s, int cell, bool past_convex,
                                            DecisionCounts& counts);

/// Whether predicates over the points of two surfaces and a direction may use floating filters.
[[nodiscard]] bool within_range(const PlacedSurface& a, const PlacedSurface& b, const Vector3& w);

}  // namespace ashlar
