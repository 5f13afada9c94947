// The half-edges of triangles: the table from which every question of connection is answered, of sound meshes
// and of others. Half-edge 3 t + k runs from corner k of triangle t to its next corner, against the direction
// of its twin in the triangle on the other side. Why it is not CGAL's: geometry/notes/half_edges.md.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace ashlar {

/// The half-edge that follows in the same triangle, and the one before.
[[nodiscard]] constexpr int next_half_edge(int h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}
[[nodiscard]] constexpr int previous_half_edge(int h) {
  return h % 3 == 0 ? h + 2 : h - 1;
}

/// The point that a half-edge starts from.
[[nodiscard]] inline int start_of(const std::vector<std::array<int, 3>>& triangles, int h) {
  return triangles[h / 3][h % 3];
}

/// Half-edges in lists by the point they start from. Any number of triangles may have an edge, in any
/// direction; the triangles need not be closed.
class HalfEdges {
 public:
  /// Empty at first. @param triangles must outlive this; added triangles must not change.
  HalfEdges(const std::vector<std::array<int, 3>>& triangles, std::size_t point_count)
      : triangles_(triangles), first_(point_count, -1), next_(3 * triangles.size(), -1) {}

  /// The three half-edges of a triangle. @pre its corners are in [0, point_count)
  void add(int triangle);
  /// Adds all triangles except those that name a point twice, which have no edges.
  void add_all();
  /// @pre the triangle is held
  void remove(int triangle);

  /// The first half-edge held that starts from a point, and the one after h from the same point; -1: none.
  [[nodiscard]] int first(int point) const { return first_[point]; }
  [[nodiscard]] int next(int h) const { return next_[h]; }
  [[nodiscard]] int start(int h) const { return start_of(triangles_, h); }
  [[nodiscard]] int end(int h) const { return start_of(triangles_, next_half_edge(h)); }
  /// A half-edge between two points, -1: none. Takes time with the number of half-edges from the first point.
  [[nodiscard]] int find(int from, int to) const {
    int h = first_[from];
    while (h >= 0 && end(h) != to) h = next_[h];
    return h;
  }

  /// All half-edges held, those of an edge after each other: by smaller end, by larger end, by number.
  [[nodiscard]] std::vector<int> sorted_by_edge() const;
  /// Calls visit(span of the half-edges of one edge) for every edge. @param sorted as sorted_by_edge() gives it
  template <class Visit>
  void for_each_edge(const std::vector<int>& sorted, Visit visit) const {
    for (std::size_t begin = 0; begin < sorted.size();) {
      std::size_t end = begin + 1;
      while (end < sorted.size() && have_same_edge(sorted[begin], sorted[end])) ++end;
      visit(std::span(sorted).subspan(begin, end - begin));
      begin = end;
    }
  }
  /// (3 #triangles) The other half-edge where an edge has two, in opposite directions; -1 elsewhere.
  [[nodiscard]] std::vector<int> twins(const std::vector<int>& sorted) const;
  [[nodiscard]] std::vector<int> twins() const { return twins(sorted_by_edge()); }

 private:
  [[nodiscard]] bool have_same_edge(int g, int h) const {
    return start(g) == start(h) ? end(g) == end(h) : start(g) == end(h) && end(g) == start(h);
  }

  const std::vector<std::array<int, 3>>& triangles_;
  std::vector<int> first_;  // by point
  std::vector<int> next_;   // by half-edge
};

}  // namespace ashlar
