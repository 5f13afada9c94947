// The common part of two convex plane sets seen along a contact direction.
//
// A set is a point, a segment or a strictly convex polygon, given by the loop of its corners,
// counter-clockwise when w points at the viewer; the two may lie at different heights along w. Their common
// part is a convex set whose vertices are of three kinds: a corner of one set inside the other (or on its
// rim), two corners that coincide, two sides that cross in inner points of both. Which of them occur, and in
// which order they follow each other, is decided by signs of w . ((b - a) x (c - a)) of given points only; no
// coordinate is computed.
#pragma once

#include <span>
#include <vector>

#include "geometry/exact/direction_predicates.hpp"

namespace ashlar {

/// One plane set. @invariant loop has 1, 2 or more entries; more: strictly convex in the projection along w.
struct PlaneSet {
  const Vector3* points = nullptr;
  std::span<const int> loop;

  [[nodiscard]] int size() const { return static_cast<int>(loop.size()); }
  [[nodiscard]] int dimension() const { return size() < 3 ? size() - 1 : 2; }
  /// Sides: none of a point, one of a segment.
  [[nodiscard]] int side_count() const { return size() < 3 ? size() - 1 : size(); }
  [[nodiscard]] const Vector3& point(int k) const { return points[loop[k < size() ? k : k - size()]]; }
};

/// Where a point lies in a plane set.
struct PlaneLocation {
  int dimension = -1;  ///< 0 at a corner, 1 inside a side, 2 inside the polygon, -1 outside
  int index = -1;      ///< of the corner or side within the loop; side k joins corners k and k + 1
};

/// One vertex of the common part.
struct OverlapVertex {
  PlaneLocation a, b;
};

/// Relative position of the two sets; it decides the necessary arithmetic.
enum class PlaneSetting {
  coplanar,  ///< both in one plane across w
  level,     ///< each in a plane across w
  tilted,    ///< neither: only their projections matter
};

/// The vertices of the common part, each once: counter-clockwise if there are three or more; empty if the
/// sets have nothing in common.
[[nodiscard]] std::vector<OverlapVertex> overlap(const ContactDirection& w, PlaneSetting setting,
                                                 const PlaneSet& a, const PlaneSet& b,
                                                 PredicateLadder& ladder);

/// The smallest face of a set that contains all of the given locations (not empty, none outside).
[[nodiscard]] PlaneLocation carrier(const PlaneSet& set, std::span<const PlaneLocation> locations);

/// Corners of the convex hull of points in the projection along w, counter-clockwise, starting anywhere; one
/// point of those that coincide in the projection, none inside a side.
[[nodiscard]] std::vector<int> projected_hull(const ContactDirection& w, const Vector3* points,
                                              const std::vector<int>& candidates, PredicateLadder& ladder);

}  // namespace ashlar
