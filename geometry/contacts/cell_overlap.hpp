// The overlap of two flat cells that face each other: a plane set each, projected along the mean of their normals.
#pragma once

#include <optional>
#include <vector>

#include "geometry/convex/overlap_polygon.hpp"
#include "geometry/subfaces/placed_surface.hpp"
#include "geometry/subfaces/view_frame.hpp"

namespace ashlar {

/// A corner of an overlap polygon with its location in both cells (corner or side by the cell's own numbering). The
/// set of corners and their origins are exact for the given doubles; the place is rounded.
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

/// The overlap of two cells; empty if it has no area.
/// @pre rounding to nearest, the normals face each other
[[nodiscard]] std::optional<CellOverlap> overlap_of_cells(const PlacedSurface& a, int cell_a,
                                                          const PlacedSurface& b, int cell_b,
                                                          DecisionCounts& counts);

/// True if a point of another surface projects along the cell's normal to the cell or its outline.
/// @pre rounding to nearest
[[nodiscard]] bool is_over_cell(const PlacedSurface& with_point, const Vector3& point, const PlacedSurface& s,
                                int cell, DecisionCounts& counts);

/// Projection of a point along a cell's normal.
struct PlaceOverCell {
  bool over = false;      ///< over the cell, on its outline, or beyond edges of its face only
  std::vector<int> past;  ///< sides beyond which it is, all of them edges of the face
};
/// @param past_convex true if it may be beyond convex edges, false: only beyond reflex ones
/// @pre rounding to nearest
[[nodiscard]] PlaceOverCell place_over_cell(const PlacedSurface& with_point, const Vector3& point,
                                            const PlacedSurface& s, int cell, bool past_convex,
                                            DecisionCounts& counts);

/// True if predicates over the points of two surfaces and a direction may use floating-point filters.
[[nodiscard]] bool within_range(const PlacedSurface& a, const PlacedSurface& b, const Vector3& w);

}  // namespace ashlar
