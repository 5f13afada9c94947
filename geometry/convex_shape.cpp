#include "geometry/convex_shape.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "geometry/rounding_mode.hpp"
#include "geometry/shapes.hpp"

namespace ashlar {

namespace {

using Triangle = std::array<int, 3>;

NumericRange checked_range(std::span<const Vector3> points) {
  NumericRange range;
  for (const Vector3& p : points) {
    if (!p.allFinite()) throw std::invalid_argument("convex shape: a coordinate is not finite");
    for (int i = 0; i < 3; ++i) range.include(p[i]);
  }
  return range;
}

ContactDirection triangle_normal(const Vector3& a, const Vector3& b, const Vector3& c) {
  return ContactDirection::cross({&b, &a}, {&c, &a});
}

// Triangles with the directed edges that lead to their neighbours; edges within former facets are flipped
// until none is concave.
class HullSurface {
 public:
  HullSurface(const std::vector<Vector3>& points, const std::vector<Triangle>& triangles, bool floating)
      : points_(points), triangles_(triangles) {
    ladder_.floating = floating;
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
      check_area(t);
      add(t);
    }
    for (const auto& [edge, t] : triangle_of_edge_)
      if (!triangle_of_edge_.contains({edge.second, edge.first}))
        throw std::invalid_argument("convex shape: the mesh is not closed");
    flip_concave_edges();
    merge_flat_edges();
  }

  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  [[nodiscard]] int group(int t) const {
    while (parent_[t] != t) t = parent_[t];
    return t;
  }
  [[nodiscard]] int across(int from, int to) const { return triangle_of_edge_.at({to, from}); }

 private:
  void check_area(int t) {
    const Triangle& c = triangles_[t];
    for (const int i : c)
      if (i < 0 || i >= static_cast<int>(points_.size()))
        throw std::invalid_argument("convex shape: triangle " + std::to_string(t) + " names no point");
    if (is_zero(triangle_normal(points_[c[0]], points_[c[1]], points_[c[2]]), ladder_))
      throw std::invalid_argument("convex shape: triangle " + std::to_string(t) + " has no area");
  }
  void add(int t) {
    const Triangle& c = triangles_[t];
    for (int k = 0; k < 3; ++k)
      if (!triangle_of_edge_.insert({{c[k], c[(k + 1) % 3]}, t}).second)
        throw std::invalid_argument("convex shape: triangles around an edge do not fit together");
  }
  void remove(int t) {
    for (int k = 0; k < 3; ++k) triangle_of_edge_.erase({triangles_[t][k], triangles_[t][(k + 1) % 3]});
  }
  [[nodiscard]] int opposite(int t, int from, int to) const {
    for (const int v : triangles_[t])
      if (v != from && v != to) return v;
    return -1;
  }
  // 1 convex, 0 flat, -1 concave.
  int bend(int from, int to) {
    const int t = triangle_of_edge_.at({from, to});
    const int far = opposite(across(from, to), from, to);
    const Triangle& c = triangles_[t];
    return -sign_along(triangle_normal(points_[c[0]], points_[c[1]], points_[c[2]]), points_[far],
                       points_[c[0]], ladder_);
  }
  void flip_concave_edges() {
    // Every flip adds the volume of a tetrahedron, so none is undone and the loop ends.
    for (bool again = true; again;) {
      again = false;
      const auto edges = triangle_of_edge_;
      for (const auto& [edge, unused] : edges) {
        const auto [from, to] = edge;
        if (from > to || !triangle_of_edge_.contains(edge) || bend(from, to) >= 0) continue;
        flip(from, to);
        again = true;
      }
    }
  }
  void flip(int from, int to) {
    const int left = triangle_of_edge_.at({from, to}), right = across(from, to);
    const int a = opposite(left, from, to), b = opposite(right, from, to);
    if (triangle_of_edge_.contains({a, b})) throw std::invalid_argument("convex shape: the mesh is concave");
    remove(left);
    remove(right);
    triangles_[left] = {a, from, b};
    triangles_[right] = {b, to, a};
    for (const int t : {left, right}) {
      check_area(t);
      add(t);
    }
  }
  void merge_flat_edges() {
    parent_.resize(triangles_.size());
    std::iota(parent_.begin(), parent_.end(), 0);
    for (const auto& [edge, t] : triangle_of_edge_)
      if (edge.first < edge.second && bend(edge.first, edge.second) == 0)
        parent_[group(t)] = group(across(edge.first, edge.second));
  }

  const std::vector<Vector3>& points_;
  std::vector<Triangle> triangles_;
  std::vector<int> parent_;
  std::map<std::pair<int, int>, int> triangle_of_edge_;
  PredicateLadder ladder_;
};

// The boundary of one group of coplanar triangles, without the points inside straight sides (those have only
// two groups around them).
std::vector<int> boundary_loop(const HullSurface& surface, int group, const std::vector<int>& group_count) {
  std::map<int, int> next;
  for (int t = 0; t < static_cast<int>(surface.triangles().size()); ++t) {
    if (surface.group(t) != group) continue;
    for (int k = 0; k < 3; ++k) {
      const int from = surface.triangles()[t][k], to = surface.triangles()[t][(k + 1) % 3];
      if (surface.group(surface.across(from, to)) != group && !next.insert({from, to}).second)
        throw std::invalid_argument("convex shape: a facet touches itself");
    }
  }
  std::vector<int> loop;
  const int start = next.begin()->first;
  std::size_t steps = 0;
  int v = start;
  do {
    if (group_count[v] > 2) loop.push_back(v);
    const auto step = next.find(v);
    if (step == next.end()) throw std::invalid_argument("convex shape: the mesh is concave");
    v = step->second;
    ++steps;
  } while (v != start);
  if (steps != next.size()) throw std::invalid_argument("convex shape: a facet has a hole");
  return loop;
}

std::vector<int> groups_around_points(const HullSurface& surface, std::size_t point_count) {
  std::vector<std::vector<int>> groups(point_count);
  for (int t = 0; t < static_cast<int>(surface.triangles().size()); ++t)
    for (const int v : surface.triangles()[t]) groups[v].push_back(surface.group(t));
  std::vector<int> count(point_count);
  for (std::size_t v = 0; v < point_count; ++v) {
    std::sort(groups[v].begin(), groups[v].end());
    count[v] = static_cast<int>(std::unique(groups[v].begin(), groups[v].end()) - groups[v].begin());
  }
  return count;
}

// A triangle of the face of the solid that has all corners of a facet, or -1.
int triangle_of_face(const Polyhedron& solid, const ConvexShape& shape, int facet) {
  for (const PolyhedronFace& face : solid.faces()) {
    const auto has = [&](int point) {
      return std::any_of(face.triangles.begin(), face.triangles.end(), [&](int t) {
        const Triangle& c = solid.mesh().triangles[t];
        return std::find(c.begin(), c.end(), point) != c.end();
      });
    };
    const std::span<const int> loop = shape.facet(facet);
    if (std::all_of(loop.begin(), loop.end(), [&](int v) { return has(shape.source_points()[v]); }))
      return face.triangles.front();
  }
  return -1;
}

}  // namespace

ConvexShape ConvexShape::from_triangle(const Vector3& a, const Vector3& b, const Vector3& c) {
  const NearestRounding nearest;
  ConvexShape shape;
  shape.flat_ = true;
  shape.corners_ = {a, b, c};
  shape.range_ = checked_range(shape.corners_);
  shape.facet_start_ = {0, 3};
  shape.facet_corners_ = shape.source_points_ = {0, 1, 2};
  shape.source_triangles_ = {0};
  PredicateLadder ladder;
  ladder.floating = shape.range_.safe();
  if (is_zero(triangle_normal(a, b, c), ladder)) throw std::invalid_argument("triangle has no area");
  shape.index();
  return shape;
}

ConvexShape ConvexShape::from_polyhedron(const Polyhedron& solid) {
  if (!solid.convex()) throw std::invalid_argument("convex shape: the solid is not convex");
  const TriangleMesh& mesh = solid.mesh();
  try {
    return from_mesh(mesh);
  } catch (const std::invalid_argument&) {
    // Rounding has pushed a point inside a flat face or straight side below the hull: it is no corner then.
    ConvexShape shape = from_mesh(make_convex_hull(mesh.points));
    for (std::size_t v = 0; v < shape.corners_.size(); ++v)
      shape.source_points_[v] = static_cast<int>(
          std::find(mesh.points.begin(), mesh.points.end(), shape.corners_[v]) - mesh.points.begin());
    for (int f = 0; f < shape.facet_count(); ++f)
      shape.source_triangles_[f] = triangle_of_face(solid, shape, f);
    return shape;
  }
}

ConvexShape ConvexShape::from_mesh(const TriangleMesh& mesh) {
  const NearestRounding nearest;
  const bool floating = checked_range(mesh.points).safe();
  const HullSurface surface(mesh.points, mesh.triangles, floating);
  const std::vector<int> group_count = groups_around_points(surface, mesh.points.size());
  ConvexShape shape;
  std::vector<int> corner_of_point(mesh.points.size(), -1);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    if (group_count[p] < 3) continue;
    corner_of_point[p] = static_cast<int>(shape.corners_.size());
    shape.corners_.push_back(mesh.points[p]);
    shape.source_points_.push_back(static_cast<int>(p));
  }
  shape.range_ = checked_range(shape.corners_);
  shape.facet_start_ = {0};
  for (int t = 0; t < static_cast<int>(surface.triangles().size()); ++t) {
    if (surface.group(t) != t) continue;
    for (const int p : boundary_loop(surface, t, group_count))
      shape.facet_corners_.push_back(corner_of_point[p]);
    shape.facet_start_.push_back(static_cast<int>(shape.facet_corners_.size()));
    shape.source_triangles_.push_back(t);
  }
  if (shape.facet_count() < 4) throw std::invalid_argument("convex shape: fewer than four facets");
  shape.index();
  return shape;
}

void ConvexShape::index() {
  std::map<std::pair<int, int>, int> edge_of_corners;
  std::vector<std::vector<int>> facets(corners_.size());
  for (int f = 0; f < facet_count(); ++f) {
    const std::span<const int> loop = facet(f);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int from = loop[k], to = loop[(k + 1) % loop.size()];
      facets[from].push_back(f);
      const auto twin = edge_of_corners.find({to, from});
      if (twin != edge_of_corners.end()) {
        edges_[twin->second].facets[1] = f;
      } else {
        edge_of_corners[{from, to}] = static_cast<int>(edges_.size());
        edges_.push_back({{from, to}, {f, f}});
      }
    }
  }
  corner_start_ = {0};
  for (std::vector<int>& around : facets) {
    corner_facets_.insert(corner_facets_.end(), around.begin(), around.end());
    corner_start_.push_back(static_cast<int>(corner_facets_.size()));
  }
  for (int f = 0; f < facet_count(); ++f) {
    const std::span<const int> loop = facet(f);
    const ContactDirection normal = triangle_normal(corners_[loop[0]], corners_[loop[1]], corners_[loop[2]]);
    (void)normal.double_double();  // part of the numbers from now on
    normals_.push_back(normal.numbers());
  }
}

int ConvexShape::find_edge(int v, int w) const {
  for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
    const auto& c = edges_[e].corners;
    if ((c[0] == v && c[1] == w) || (c[0] == w && c[1] == v)) return e;
  }
  return -1;
}

int ConvexShape::find_facet(std::span<const int> corners) const {
  for (const int f : facets_of_corner(corners[0])) {
    const std::span<const int> loop = facet(f);
    if (std::all_of(corners.begin(), corners.end(),
                    [&](int v) { return std::find(loop.begin(), loop.end(), v) != loop.end(); }))
      return f;
  }
  return -1;
}

ContactDirection ConvexShape::facet_normal(int f) const {
  const std::span<const int> loop = facet(f);
  return ContactDirection::cross({&corners_[loop[1]], &corners_[loop[0]]},
                                 {&corners_[loop[2]], &corners_[loop[0]]}, normals_[f]);
}

}  // namespace ashlar
