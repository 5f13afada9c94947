// The surface of a convex mesh on its way to a ConvexShape: concave edges flipped, flat ones dissolved,
// facets walked around.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/exact/direction_predicates.hpp"

namespace ashlar {

/// Half-edges by the point they start from: half-edge 3 t + k runs from corner k of triangle t to the next
/// one.
class HalfEdges {
 public:
  /// Holds none yet. @param triangles must outlive this; may change, but not in the triangles of half-edges
  /// that are held.
  HalfEdges(const std::vector<std::array<int, 3>>& triangles, std::size_t point_count)
      : triangles_(triangles), first_(point_count, -1), next_(3 * triangles.size(), -1) {}

  void add(int h);
  void remove(int h);
  /// The first half-edge held that starts from a point, and the one after h from the same point; -1: none.
  [[nodiscard]] int first(int point) const { return first_[point]; }
  [[nodiscard]] int next(int h) const { return next_[h]; }
  [[nodiscard]] int end(int h) const { return triangles_[h / 3][h % 3 == 2 ? 0 : h % 3 + 1]; }
  /// The half-edge between two points, or -1.
  [[nodiscard]] int find(int from, int to) const {
    int h = first_[from];
    while (h >= 0 && end(h) != to) h = next_[h];
    return h;
  }

 private:
  const std::vector<std::array<int, 3>>& triangles_;
  std::vector<int> first_;  // by point
  std::vector<int> next_;   // by half-edge
};

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
  void remove(int t);
  [[nodiscard]] int opposite(int h) const { return triangles_[h / 3][h % 3 == 0 ? 2 : h % 3 - 1]; }
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
