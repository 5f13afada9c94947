// Outlines of the overlaps of faces without what only rounding adds to them: faces whose edges lie on each
// other to the last bit meet in polygons with corners that stick out by nothing, or in slivers without width.
// The polygons are exact for the coordinates as they are; where springs act must not depend on their last
// bits, or a scene that is turned, moved or one step on would have other springs.
#pragma once

#include <vector>

#include "geometry/contacts/overlap_vertices.hpp"

namespace ashlar {

/// Rounding of the bodies' coordinates and of differences of them, m: 16 units in the last place of the
/// farthest from the origin.
[[nodiscard]] double coordinate_rounding(const PlacedSurface& a, const PlacedSurface& b);

/// How far corners may be off by rounding, m: 1e-10 of the smaller body's size (PlacedSurface::size), and
/// never less than coordinate_rounding().
[[nodiscard]] double outline_tolerance(const PlacedSurface& a, const PlacedSurface& b);

/// Corners of an overlap, in order, in its frame.
[[nodiscard]] std::vector<Eigen::Vector2d> places_of(const CellOverlap& overlap);

/// A polygon without corners that are within a tolerance of the line between their neighbours, the least ones
/// first. @param polygon in order @return at least 3 corners in the same order, or none if nothing is wider
/// than the tolerance
[[nodiscard]] std::vector<Eigen::Vector2d> outline_of(std::vector<Eigen::Vector2d> polygon, double tolerance);

/// The overlap of two faces.
struct FaceOutline {
  std::vector<FaceOverlapPoint> corners;  ///< of face.points, those where the outline turns
  double area;                            ///< m^2
};

/// Corners are looked at with a blur of a thousandth of the root of the area, as sides that lie almost on
/// each other cross anywhere: points another one stands for within it are left out, and so are those that
/// stand for no corner of a piece when its slivers and nearly straight corners are taken away and, unless
/// `divided`, those where the outline of all pieces turns by less than 0.01 rad. Where nothing is wider than
/// the blur, the tolerance alone is what counts.
/// @param divided faces curve: corners of the pieces are points, also inside
[[nodiscard]] FaceOutline outline_of(const FaceOverlap& face, const std::vector<CellOverlap>& overlaps,
                                     bool divided, double tolerance);

/// Area of a polygon in counter-clockwise order.
[[nodiscard]] double area_of(const std::vector<Eigen::Vector2d>& polygon);

}  // namespace ashlar
