#include "geometry/any_solid/solid_features.hpp"

#include <algorithm>

namespace ashlar {

SolidFeatures::SolidFeatures(const Polyhedron& solid)
    : solid_(solid),
      sides_(solid.faces().size()),
      edge_of_point_(solid.mesh().points.size(), -1),
      corner_kind_(solid.mesh().points.size(), CornerKind::convex),
      ray_start_(solid.mesh().points.size() + 1, 0) {
  const auto& triangles = solid.mesh().triangles;
  triangle_left_of_.reserve(3 * triangles.size());
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      triangle_left_of_[key(triangles[t][k], triangles[t][(k + 1) % 3])] = t;
      ++ray_start_[triangles[t][k] + 1];
    }
  for (std::size_t v = 1; v < ray_start_.size(); ++v) ray_start_[v] += ray_start_[v - 1];
  rays_.resize(3 * triangles.size());
  std::vector<int> next(ray_start_.begin(), ray_start_.end() - 1);
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) rays_[next[triangles[t][k]]++] = {triangles[t][(k + 1) % 3], t, -1};

  // Two corners are joined by one straight line, so by at most one edge.
  std::unordered_map<std::uint64_t, int> edge_between;
  for (int e = 0; e < static_cast<int>(solid.edges().size()); ++e) {
    const PolyhedronEdge& edge = solid.edges()[e];
    edges_.push_back({edge.vertices[0], edge.vertices[1], -1, -1, edge.convex});
    edge_between[key(edge.vertices[0], edge.vertices[1])] = e;
    sides_[edge.faces[0]].push_back({edge.vertices[0], edge.vertices[1], e});
    sides_[edge.faces[1]].push_back({edge.vertices[1], edge.vertices[0], e});
  }
  for (const int v : solid.corners())
    for (int r = ray_start_[v]; r < ray_start_[v + 1]; ++r)
      if (is_sharp(v, rays_[r].to)) follow(v, rays_[r].to, edge_between);
  for (int v = 0; v + 1 < static_cast<int>(ray_start_.size()); ++v)
    for (int r = ray_start_[v]; r < ray_start_[v + 1]; ++r) {
      const auto edge = edge_of_side_.find(key(v, rays_[r].to));
      if (edge != edge_of_side_.end()) rays_[r].edge = edge->second;
    }
  classify_corners();
}

int SolidFeatures::apex(int from, int to) const {
  for (const int v : solid_.mesh().triangles[triangle_left_of_.at(key(from, to))])
    if (v != from && v != to) return v;
  return -1;
}

int SolidFeatures::next_sharp(int previous, int v) const {
  for (int r = ray_start_[v]; r < ray_start_[v + 1]; ++r)
    if (rays_[r].to != previous && is_sharp(v, rays_[r].to)) return rays_[r].to;
  return -1;
}

// Records the pieces of the edge that begins at a corner with a given sharp side.
void SolidFeatures::follow(int from, int first, const std::unordered_map<std::uint64_t, int>& edge_between) {
  std::vector<int> path{from, first};
  while (!std::binary_search(solid_.corners().begin(), solid_.corners().end(), path.back()))
    path.push_back(next_sharp(path[path.size() - 2], path.back()));
  const auto found = edge_between.find(key(path.front(), path.back()));
  if (found == edge_between.end()) return;  // it is found from its other end
  SolidEdge& edge = edges_[found->second];
  edge.left_apex = apex(path[0], path[1]);
  edge.right_apex = apex(path[1], path[0]);
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    edge_of_side_[key(path[k], path[k + 1])] = edge_of_side_[key(path[k + 1], path[k])] = found->second;
    if (k > 0) edge_of_point_[path[k]] = found->second;
  }
}

void SolidFeatures::classify_corners() {
  std::vector<char> has_convex(corner_kind_.size(), 0), has_reflex(corner_kind_.size(), 0);
  for (const SolidEdge& edge : edges_)
    for (const int v : {edge.from, edge.to}) (edge.convex ? has_convex : has_reflex)[v] = 1;
  for (const int v : solid_.corners())
    corner_kind_[v] = has_reflex[v] == 0   ? CornerKind::convex
                      : has_convex[v] == 0 ? CornerKind::reflex
                                           : CornerKind::saddle;
}

ContactFeature SolidFeatures::feature_of_point(int v, int triangle) const {
  if (std::binary_search(solid_.corners().begin(), solid_.corners().end(), v)) return {0, v};
  return edge_of_point_[v] >= 0 ? ContactFeature{1, edge_of_point_[v]} : ContactFeature{2, face(triangle)};
}

ContactFeature SolidFeatures::feature_of_side(int from, int to, int triangle) const {
  const auto edge = edge_of_side_.find(key(from, to));
  return edge != edge_of_side_.end() ? ContactFeature{1, edge->second} : ContactFeature{2, face(triangle)};
}

std::vector<int> SolidFeatures::triangles_at(int v) const {
  std::vector<int> triangles;
  for (int r = ray_start_[v]; r < ray_start_[v + 1]; ++r) triangles.push_back(rays_[r].triangle);
  return triangles;
}

bool SolidFeatures::admits(const SolidEdge& edge, const ContactDirection& w, int sign,
                           PredicateLadder& ladder) const {
  return edge.convex && sign * sign_along(w, point(edge.left_apex), point(edge.from), ladder) >= 0 &&
         sign * sign_along(w, point(edge.right_apex), point(edge.from), ladder) >= 0;
}

bool SolidFeatures::rays_admit(int corner, const ContactDirection& w, int sign,
                               PredicateLadder& ladder) const {
  for (int r = ray_start_[corner]; r < ray_start_[corner + 1]; ++r)
    if (sign * sign_along(w, point(rays_[r].to), point(corner), ladder) < 0) return false;
  return true;
}

bool SolidFeatures::lies_on_side_of(int corner, const RationalVector& w) const {
  if (corner_kind_[corner] != CornerKind::saddle) return corner_kind_[corner] == CornerKind::convex;
  // Greatest angle to w: least w . e / |e|, where no w . e is negative.
  const int first = ray_start_[corner];
  int lowest = first;
  Rational squared_rise, squared_length;
  const RationalVector apex_point = to_rational(point(corner));
  for (int r = first; r < ray_start_[corner + 1]; ++r) {
    const RationalVector e = difference(to_rational(point(rays_[r].to)), apex_point);
    const Rational rise = dot_product(w, e), length = dot_product(e, e);
    const Rational squared(rise * rise);
    if (r != first && squared * squared_length >= squared_rise * length) continue;
    lowest = r;
    squared_rise = squared;
    squared_length = length;
  }
  return lies_on_side_of(rays_[lowest], w);
}

bool SolidFeatures::lies_on_side_of(const Ray& lowest, const RationalVector& w) const {
  if (lowest.edge >= 0) return edges_[lowest.edge].convex;
  const auto& [i, j, k] = solid_.mesh().triangles[lowest.triangle];
  const RationalVector a = to_rational(point(i));
  const RationalVector normal =
      cross_product(difference(to_rational(point(j)), a), difference(to_rational(point(k)), a));
  return sgn(dot_product(normal, w)) < 0;
}

bool SolidFeatures::lies_beyond(int corner, const Vector3& from, bool floating) const {
  if (corner_kind_[corner] != CornerKind::saddle) return corner_kind_[corner] == CornerKind::convex;
  const Vector3& p = point(corner);
  if (floating) {
    const int first = ray_start_[corner];
    int lowest = first;
    const NumberVector<TrackedNumber> w = evaluate<TrackedNumber>({&p, &from});
    TrackedNumber squared_rise, squared_length;
    for (int r = first; r < ray_start_[corner + 1]; ++r) {
      const NumberVector<TrackedNumber> e = evaluate<TrackedNumber>({&point(rays_[r].to), &p});
      const TrackedNumber rise = dot(w, e), length = dot(e, e), squared = rise * rise;
      const int order = r == first ? -1 : sign_of(squared * squared_length - squared_rise * length);
      if (order == 0 || order == unknown_sign)
        return lies_on_side_of(corner, difference(to_rational(p), to_rational(from)));
      if (order > 0) continue;
      lowest = r;
      squared_rise = squared;
      squared_length = length;
    }
    const int edge = rays_[lowest].edge;
    if (edge >= 0) return edges_[edge].convex;
  }
  return lies_on_side_of(corner, difference(to_rational(p), to_rational(from)));
}

}  // namespace ashlar
