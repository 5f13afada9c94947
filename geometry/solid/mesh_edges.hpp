// The edges of a triangle mesh, however often each is used: the table all questions of connection are
// answered from. Half-edge 3 t + k runs from corner k of triangle t to corner (k + 1) % 3.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// One side of an edge, sorted so that the half-edges of an edge follow each other.
struct EdgeUse {
  std::uint64_t edge;  ///< smaller point in the upper half, larger point in the lower half
  int halfedge;

  [[nodiscard]] int low() const { return static_cast<int>(edge >> 32U); }
  [[nodiscard]] int high() const { return static_cast<int>(edge & 0xffffffffU); }
  [[nodiscard]] int triangle() const { return halfedge / 3; }
};

[[nodiscard]] inline int next_halfedge(int h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}

[[nodiscard]] inline int origin(const std::vector<std::array<int, 3>>& triangles, int h) {
  return triangles[h / 3][h % 3];
}

/// All half-edges of all triangles, sorted by edge, then by half-edge. Triangles that name a point twice have
/// no edges.
[[nodiscard]] std::vector<EdgeUse> sorted_edge_uses(const std::vector<std::array<int, 3>>& triangles);

/// Calls visit(span of the uses of one edge) for every edge.
template <class Visit>
void for_each_edge(const std::vector<EdgeUse>& uses, Visit visit) {
  for (std::size_t begin = 0; begin < uses.size();) {
    std::size_t end = begin + 1;
    while (end < uses.size() && uses[end].edge == uses[begin].edge) ++end;
    visit(std::span(uses).subspan(begin, end - begin));
    begin = end;
  }
}

}  // namespace ashlar
