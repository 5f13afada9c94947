// Outlines of the overlaps of faces without effects of rounding. Faces with coincident edges meet in polygons with
// additional corners of zero height, or in slivers of zero width. The polygons are exact for the given coordinates.
// The places of springs must not depend on their last bits, or a scene that is rotated, translated or one step later
// would have other springs.
#pragma once

#include <vector>

#include "geometry/contacts/overlap_vertices.hpp"

namespace ashlar {

/// Rounding error of the bodies' coordinates and of their differences, m: 16 units in the last place of the point
/// farthest from the origin.
[[nodiscard]] double coordinate_rounding(const PlacedSurface& a, const PlacedSurface& b);

/// Rounding error of corners, m: 1e-10 of the smaller body's size (PlacedSurface::size), at least
/// coordinate_rounding().
[[nodiscard]] double outline_tolerance(const PlacedSurface& a, const PlacedSurface& b);

/// Corners of an overlap, in order, in its frame.
[[nodiscard]] std::vector<Eigen::Vector2d> places_of(const CellOverlap& overlap);

/// A polygon without corners that are within a tolerance of the line between their neighbours, removed in increasing
/// order of distance. @param polygon in order. @return at least 3 corners in the same order, or none if the width is
/// within the tolerance
[[nodiscard]] std::vector<Eigen::Vector2d> outline_of(std::vector<Eigen::Vector2d> polygon, double tolerance);

/// The overlap of two faces.
struct FaceOutline {
  std::vector<FaceOverlapPoint> corners;  ///< those of face.points at which the outline turns
  double area;                            ///< m^2
};

/// Corners are compared with a blur of a thousandth of the root of the area, as the crossing of almost coincident
/// sides is arbitrary. Removed are points represented by another one within the blur, and points that are no corner
/// of any piece after removal of its slivers and nearly straight corners. Unless `divided`, corners at which the
/// outline of all pieces turns by less than 0.01 rad are removed too. If the width is within the blur, only the
/// tolerance is used.
/// @param divided faces curve: corners of the pieces are points, also inside
[[nodiscard]] FaceOutline outline_of(const FaceOverlap& face, const std::vector<CellOverlap>& overlaps,
                                     bool divided, double tolerance);

/// Area of a polygon in counter-clockwise order.
[[nodiscard]] double area_of(const std::vector<Eigen::Vector2d>& polygon);

}  // namespace ashlar
