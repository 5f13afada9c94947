#include "geometry/convex/convex_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "geometry/exact/rounding_mode.hpp"
#include "geometry/solid/hull_surface.hpp"
#include "geometry/solid/shapes.hpp"

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
  ladder.open(shape.range_);
  if (is_zero(triangle_normal(a, b, c), ladder)) throw std::invalid_argument("triangle has no area");
  shape.index();
  return shape;
}

ConvexShape ConvexShape::from_polyhedron(const Polyhedron& solid) {
  if (!solid.convex()) throw std::invalid_argument("convex shape: the solid is not convex");
  ConvexShape shape = hull_of(solid.mesh());
  for (int f = 0; f < shape.facet_count(); ++f)
    if (shape.source_triangles_[f] < 0) shape.source_triangles_[f] = triangle_of_face(solid, shape, f);
  return shape;
}

ConvexShape ConvexShape::hull_of(const TriangleMesh& mesh) {
  try {
    return from_mesh(mesh);
  } catch (const std::invalid_argument&) {
    // Rounding has pushed a point inside a flat face or straight side below the hull: it is no corner then.
    ConvexShape shape = from_mesh(make_convex_hull(mesh.points));
    for (std::size_t v = 0; v < shape.corners_.size(); ++v)
      shape.source_points_[v] = static_cast<int>(
          std::find(mesh.points.begin(), mesh.points.end(), shape.corners_[v]) - mesh.points.begin());
    shape.source_triangles_.assign(shape.source_triangles_.size(), -1);
    return shape;
  }
}

ConvexShape ConvexShape::from_mesh(const TriangleMesh& mesh) {
  const NearestRounding nearest;
  const bool floating = checked_range(mesh.points).safe();
  const HullSurface surface(mesh.points, mesh.triangles, floating);
  const std::vector<int>& group_count = surface.group_counts();
  FacetBoundaries boundaries(surface);
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
    for (const int p : boundaries.loop(t)) shape.facet_corners_.push_back(corner_of_point[p]);
    shape.facet_start_.push_back(static_cast<int>(shape.facet_corners_.size()));
    shape.source_triangles_.push_back(t);
  }
  if (shape.facet_count() < 4) throw std::invalid_argument("convex shape: fewer than four facets");
  shape.index();
  return shape;
}

void ConvexShape::index() {
  // The edges that start from a corner are linked, the last one first.
  std::vector<int> last_edge(corners_.size(), -1), edge_before;
  edge_before.reserve(facet_corners_.size());
  edges_.reserve(facet_corners_.size());
  facet_edges_.reserve(facet_corners_.size());
  for (int f = 0; f < facet_count(); ++f) {
    const std::span<const int> loop = facet(f);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int from = loop[k], to = loop[(k + 1) % loop.size()];
      int twin = last_edge[to];
      while (twin >= 0 && edges_[twin].corners[1] != from) twin = edge_before[twin];
      if (twin >= 0) {
        edges_[twin].facets[1] = f;
        facet_edges_.push_back(twin);
      } else {
        edge_before.push_back(std::exchange(last_edge[from], static_cast<int>(edges_.size())));
        facet_edges_.push_back(static_cast<int>(edges_.size()));
        edges_.push_back({{from, to}, {f, f}});
      }
    }
  }
  index_facets_of_corners();
  normals_.reserve(static_cast<std::size_t>(facet_count()));
  squared_normals_.reserve(static_cast<std::size_t>(facet_count()));
  for (int f = 0; f < facet_count(); ++f) {
    const std::span<const int> loop = facet(f);
    const ContactDirection normal = triangle_normal(corners_[loop[0]], corners_[loop[1]], corners_[loop[2]]);
    (void)normal.double_double();  // part of the numbers from now on
    normals_.push_back(normal.numbers());
    squared_normals_.push_back(dot(normal.tracked(), normal.tracked()));
  }
  low_ = high_ = corners_[0];
  for (const Vector3& p : corners_) {
    low_ = low_.cwiseMin(p);
    high_ = high_.cwiseMax(p);
  }
}

void ConvexShape::index_facets_of_corners() {
  corner_start_.assign(corners_.size() + 1, 0);
  for (const int v : facet_corners_) ++corner_start_[v + 1];
  std::partial_sum(corner_start_.begin(), corner_start_.end(), corner_start_.begin());
  corner_facets_.resize(facet_corners_.size());
  std::vector<int> place(corner_start_.begin(), corner_start_.end() - 1);
  for (int f = 0; f < facet_count(); ++f)
    for (const int v : facet(f)) corner_facets_[place[v]++] = f;
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
