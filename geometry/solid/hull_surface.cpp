#include "geometry/solid/hull_surface.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace ashlar {

namespace {

constexpr signed char not_known = 2;

}  // namespace

HullSurface::HullSurface(const std::vector<Vector3>& points, const std::vector<std::array<int, 3>>& triangles,
                         bool floating)
    : points_(points),
      triangles_(triangles),
      half_edges_(triangles_, points.size()),
      bend_(3 * triangles.size(), not_known) {
  ladder_.floating = floating;
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
    check_area(t);
    add(t);
  }
  for (const auto& c : triangles_)
    for (int k = 0; k < 3; ++k)
      if (half_edges_.find(c[(k + 1) % 3], c[k]) < 0)
        throw std::invalid_argument("convex shape: the mesh is not closed");
  std::vector<Edge> edges = sorted_edges();
  while (flip_concave_edges(edges)) edges = sorted_edges();
  merge_flat_edges(edges);
  count_groups();
}

void HullSurface::check_area(int t) {
  const auto& c = triangles_[t];
  for (const int i : c)
    if (i < 0 || i >= static_cast<int>(points_.size()))
      throw std::invalid_argument("convex shape: triangle " + std::to_string(t) + " names no point");
  const Vector3 &x = points_[c[0]], &y = points_[c[1]], &z = points_[c[2]];
  if (is_zero(ContactDirection::cross({&y, &x}, {&z, &x}), ladder_))
    throw std::invalid_argument("convex shape: triangle " + std::to_string(t) + " has no area");
}

void HullSurface::add(int t) {
  const auto& c = triangles_[t];
  for (int k = 0; k < 3; ++k)
    if (half_edges_.find(c[k], c[(k + 1) % 3]) >= 0)
      throw std::invalid_argument("convex shape: triangles around an edge do not fit together");
  half_edges_.add(t);
}

// 1 convex, 0 flat, -1 concave.
int HullSurface::bend(int h, int twin) {
  if (bend_[h] == not_known) {
    const auto& c = triangles_[h / 3];
    bend_[h] = static_cast<signed char>(
        -sign_volume(points_[c[0]], points_[opposite(twin)], points_[c[1]], points_[c[2]], ladder_));
  }
  return bend_[h];
}

// From the smaller to the larger point, in order.
std::vector<HullSurface::Edge> HullSurface::sorted_edges() const {
  std::vector<Edge> edges;
  edges.reserve(triangles_.size() * 3 / 2);
  for (int from = 0; from < static_cast<int>(points_.size()); ++from) {
    const auto begin = static_cast<std::ptrdiff_t>(edges.size());
    for (int h = half_edges_.first(from); h >= 0; h = half_edges_.next(h)) {
      const int to = half_edges_.end(h);
      if (to > from) edges.push_back({from, to, h, half_edges_.find(to, from)});
    }
    std::sort(edges.begin() + begin, edges.end(), [](const Edge& x, const Edge& y) { return x.to < y.to; });
  }
  return edges;
}

// @return true if there were any. Every flip adds the volume of a tetrahedron, so that none is undone and this ends.
bool HullSurface::flip_concave_edges(const std::vector<Edge>& edges) {
  bool flipped = false;
  for (Edge e : edges) {
    if (flipped) {
      e.half_edge = half_edges_.find(e.from, e.to);
      if (e.half_edge < 0) continue;
      e.twin = half_edges_.find(e.to, e.from);
    }
    if (bend(e.half_edge, e.twin) >= 0) continue;
    flip(e.half_edge, e.twin);
    flipped = true;
  }
  return flipped;
}

void HullSurface::flip(int h, int twin) {
  const int left = h / 3, right = twin / 3;
  const int from = half_edges_.start(h), to = half_edges_.start(twin);
  const int a = opposite(h), b = opposite(twin);
  if (half_edges_.find(a, b) >= 0) throw std::invalid_argument("convex shape: the mesh is concave");
  half_edges_.remove(left);
  half_edges_.remove(right);
  triangles_[left] = {a, from, b};
  triangles_[right] = {b, to, a};
  for (const int t : {left, right}) {
    check_area(t);
    add(t);
  }
  for (const int t : {left, right})
    for (int k = 0; k < 3; ++k) {
      bend_[3 * t + k] = not_known;
      bend_[half_edges_.find(triangles_[t][(k + 1) % 3], triangles_[t][k])] = not_known;
    }
}

// All edges have been found convex or flat.
void HullSurface::merge_flat_edges(const std::vector<Edge>& edges) {
  group_.resize(triangles_.size());
  std::iota(group_.begin(), group_.end(), 0);
  const auto root = [this](int t) {
    while (group_[t] != t) t = group_[t];
    return t;
  };
  for (const Edge& e : edges)
    if (bend_[e.half_edge] == 0) group_[root(e.half_edge / 3)] = root(e.twin / 3);
  for (int t = 0; t < static_cast<int>(group_.size()); ++t) group_[t] = root(t);
}

void HullSurface::count_groups() {
  group_counts_.resize(points_.size());
  std::vector<int> groups;
  for (std::size_t v = 0; v < points_.size(); ++v) {
    groups.clear();
    for (int h = half_edges_.first(static_cast<int>(v)); h >= 0; h = half_edges_.next(h))
      groups.push_back(group_[h / 3]);
    std::sort(groups.begin(), groups.end());
    group_counts_[v] = static_cast<int>(std::unique(groups.begin(), groups.end()) - groups.begin());
  }
}

FacetBoundaries::FacetBoundaries(const HullSurface& surface)
    : surface_(surface),
      start_(surface.triangles().size() + 1, 0),
      members_(surface.triangles().size()),
      next_(surface.group_counts().size(), -1) {
  const int count = static_cast<int>(members_.size());
  for (int t = 0; t < count; ++t) ++start_[surface.group(t) + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  std::vector<int> place(start_.begin(), start_.end() - 1);
  for (int t = 0; t < count; ++t) members_[place[surface.group(t)]++] = t;
}

const std::vector<int>& FacetBoundaries::loop(int group) {
  loop_.clear();
  const int side_count = link_sides(group);
  int steps = 0, v = first_;
  do {
    if (surface_.group_counts()[v] > 2) loop_.push_back(v);
    v = std::exchange(next_[v], -1);
    if (v < 0) throw std::invalid_argument("convex shape: the mesh is concave");
    ++steps;
  } while (v != first_);
  if (steps != side_count) throw std::invalid_argument("convex shape: a facet has a hole");
  return loop_;
}

// Fills next_ and first_, the smallest point on the boundary.
int FacetBoundaries::link_sides(int group) {
  first_ = static_cast<int>(next_.size());
  int count = 0;
  for (int i = start_[group]; i < start_[group + 1]; ++i) {
    const auto& c = surface_.triangles()[members_[i]];
    for (int k = 0; k < 3; ++k) {
      const int from = c[k], to = c[(k + 1) % 3];
      if (surface_.group(surface_.across(from, to)) == group) continue;
      if (next_[from] >= 0) throw std::invalid_argument("convex shape: a facet touches itself");
      next_[from] = to;
      first_ = std::min(first_, from);
      ++count;
    }
  }
  return count;
}

}  // namespace ashlar
