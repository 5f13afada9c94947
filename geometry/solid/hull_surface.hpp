// The surface of a convex mesh on its way to a ConvexShape: concave edges flipped, flat ones dissolved,
// facets walked around.
#pragma once

#include <array>
#include <vector>

#include "geometry/exact/direction_predicates.hpp"
#include "geometry/solid/half_edges.hpp"

namespace ashlar {

/// A closed triangle mesh whose concave edges, all of them within former facets, have been flipped until none
/// is left. Triangles across flat edges form groups, the facets.
class HullSurface {
 public:
  /// @param points must outlive this. @param floating their NumericRange is safe. @pre rounding to nearest.
  /// @throws std::invalid_argument as ConvexShape::from_mesh.
  HullSurface(const std::vector<Vector3>& points, const std::vector<std::array<int, 3>>& triangles,
              bool floating);
  HullSurface(const HullSurface&) = delete;
  HullSurface& operator=(const HullSurface&) = delete;

  [[nodiscard]] const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  /// A triangle of the facet that triangle t belongs to, the same for all of them.
  [[nodiscard]] int group(int t) const { return group_[t]; }
  [[nodiscard]] int across(int from, int to) const { return half_edges_.find(to, from) / 3; }
  /// (#points): how many facets there are around each.
  [[nodiscard]] const std::vector<int>& group_counts() const { return group_counts_; }

 private:
  struct Edge {
    int from, to;
    int half_edge, twin;  // valid until the next flip nearby
  };

  void check_area(int t);
  void add(int t);
  [[nodiscard]] int opposite(int h) const { return half_edges_.start(previous_half_edge(h)); }
  int bend(int h, int twin);
  [[nodiscard]] std::vector<Edge> sorted_edges() const;
  bool flip_concave_edges(const std::vector<Edge>& edges);
  void flip(int h, int twin);
  void merge_flat_edges(const std::vector<Edge>& edges);
  void count_groups();

  const std::vector<Vector3>& points_;
  std::vector<std::array<int, 3>> triangles_;
  HalfEdges half_edges_;
  std::vector<signed char> bend_;  // by half-edge that starts from the smaller point
  std::vector<int> group_;         // by triangle
  std::vector<int> group_counts_;
  PredicateLadder ladder_;
};

/// Walks around the facets of a surface.
class FacetBoundaries {
 public:
  explicit FacetBoundaries(const HullSurface& surface);

  /// Corners of a facet in order, counter-clockwise from outside, from the smallest point on; without points
  /// inside straight sides (those have only two facets around them). Valid until the next call.
  /// @param group as HullSurface::group names it.
  /// @throws std::invalid_argument if the facet has a hole or touches itself.
  [[nodiscard]] const std::vector<int>& loop(int group);

 private:
  int link_sides(int group);

  const HullSurface& surface_;
  std::vector<int> start_, members_;  // triangles of each group
  std::vector<int> next_;             // by point
  int first_ = 0;
  std::vector<int> loop_;
};

}  // namespace ashlar
