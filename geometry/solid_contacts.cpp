#include "geometry/solid_contacts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "geometry/solid_relation.hpp"

namespace ashlar {

namespace {

// Which face, edge or corner of a solid a part of one of its triangles belongs to.
class FeatureMap {
 public:
  explicit FeatureMap(const Polyhedron& solid) : solid_(solid) {
    const auto& triangles = solid.mesh().triangles;
    for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
      for (int k = 0; k < 3; ++k) face_left_of_[{triangles[t][k], triangles[t][(k + 1) % 3]}] = face(t);
    for (const auto& [side, left] : face_left_of_)
      if (left != face_left_of_.at({side.second, side.first})) next_sharp_[side.first].push_back(side.second);
    for (int e = 0; e < static_cast<int>(solid.edges().size()); ++e) follow(e);
  }

  [[nodiscard]] ReportedFeature feature(int triangle, const ConvexShape& shape,
                                        const ContactFeature& part) const {
    const auto& points = solid_.mesh().triangles[triangle];
    if (part.dimension == 0) return point_feature(points[part.index], triangle);
    if (part.dimension == 1) {
      const auto& [from, to] = shape.edges()[part.index].corners;
      const auto edge = edge_of_side_.find({points[from], points[to]});
      if (edge != edge_of_side_.end()) return {1, edge->second, {}};
    }
    return {2, face(triangle), {}};
  }
  /// True if a feature is part of another one or the same.
  [[nodiscard]] bool is_in_closure(const ReportedFeature& part, const ReportedFeature& whole) const {
    if (part == whole) return true;
    if (part.dimension >= whole.dimension) return false;
    const auto has = [](const auto& range, int value) {
      return std::find(range.begin(), range.end(), value) != range.end();
    };
    if (whole.dimension == 1) return has(solid_.edges()[whole.index].vertices, part.index);
    if (part.dimension == 1) return has(solid_.edges()[part.index].faces, whole.index);
    const auto& loops = solid_.faces()[whole.index].loops;
    return std::any_of(loops.begin(), loops.end(), [&](const auto& loop) { return has(loop, part.index); });
  }

 private:
  [[nodiscard]] int face(int triangle) const { return solid_.face_of_triangle()[triangle]; }
  [[nodiscard]] bool is_corner(int v) const {
    return std::binary_search(solid_.corners().begin(), solid_.corners().end(), v);
  }
  [[nodiscard]] ReportedFeature point_feature(int v, int triangle) const {
    if (is_corner(v)) return {0, v, {}};
    const auto edge = edge_of_point_.find(v);
    if (edge != edge_of_point_.end()) return {1, edge->second, {}};
    return {2, face(triangle), {}};
  }
  // Sides of triangles along an edge, from its first corner with its left face at the left.
  void follow(int e) {
    const PolyhedronEdge& edge = solid_.edges()[e];
    for (const int first : next_sharp_[edge.vertices[0]]) {
      std::vector<int> path{edge.vertices[0], first};
      if (face_left_of_.at({path[0], path[1]}) != edge.faces[0] ||
          face_left_of_.at({path[1], path[0]}) != edge.faces[1])
        continue;
      while (!is_corner(path.back())) {
        const std::vector<int>& ends = next_sharp_[path.back()];
        path.push_back(ends[0] == path[path.size() - 2] ? ends[1] : ends[0]);
      }
      if (path.back() != edge.vertices[1]) continue;
      for (std::size_t k = 0; k + 1 < path.size(); ++k) {
        edge_of_side_[{path[k], path[k + 1]}] = edge_of_side_[{path[k + 1], path[k]}] = e;
        if (k > 0) edge_of_point_[path[k]] = e;
      }
    }
  }

  const Polyhedron& solid_;
  std::map<std::pair<int, int>, int> face_left_of_;  // by side of a triangle in its direction
  std::map<int, std::vector<int>> next_sharp_;       // ends of the sharp sides from a point
  std::map<std::pair<int, int>, int> edge_of_side_;
  std::map<int, int> edge_of_point_;  // points inside straight edges
};

bool less(const Vector3& p, const Vector3& q) {
  return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
}

class ContactCollector {
 public:
  ContactCollector(const Polyhedron& a, const Polyhedron& b, double gap)
      : a_(a), b_(b), map_a_(a), map_b_(b), gap_(gap) {}

  void add(int t, int s) {
    const ConvexShape shape_a = triangle(a_, t), shape_b = triangle(b_, s);
    const ConvexContact contact = classify(shape_a, shape_b);
    const ContactRegion& region = contact.region;
    const ReportedFeature fa = map_a_.feature(t, shape_a, region.a),
                          fb = map_b_.feature(s, shape_b, region.b);
    ReportedContact& merged = contacts_[{key(fa), key(fb)}];
    merged.a = fa;
    merged.b = fb;
    merged.type = contact_type(fa.dimension, fb.dimension);
    merged.region_dimension = std::max(merged.region_dimension, region.dimension);
    for (std::size_t k = 2; region.dimension == 2 && k < region.points.size(); ++k)
      merged.area += 0.5 * (region.points[k - 1].on_a - region.points[0].on_a)
                               .cross(region.points[k].on_a - region.points[0].on_a)
                               .norm();
    for (const RegionVertex& v : region.points)
      add_point(merged, v, map_a_.feature(t, shape_a, v.a), map_b_.feature(s, shape_b, v.b), contact.normal);
  }

  [[nodiscard]] std::vector<ReportedContact> contacts() const {
    std::vector<ReportedContact> result;
    for (const auto& [k, contact] : contacts_)
      if (!belongs_to_another(contact)) result.push_back(contact);
    return result;
  }

 private:
  using Key = std::pair<int, int>;

  static Key key(const ReportedFeature& f) { return {f.dimension, f.index}; }
  static ConvexShape triangle(const Polyhedron& solid, int t) {
    const auto& [i, j, k] = solid.mesh().triangles[t];
    const auto& x = solid.mesh().points;
    return ConvexShape::from_triangle(x[i], x[j], x[k]);
  }
  [[nodiscard]] bool belongs_to_another(const ReportedContact& part) const {
    return std::any_of(contacts_.begin(), contacts_.end(), [&](const auto& entry) {
      const ReportedContact& whole = entry.second;
      return &whole != &part && map_a_.is_in_closure(part.a, whole.a) &&
             map_b_.is_in_closure(part.b, whole.b);
    });
  }
  [[nodiscard]] bool are_parallel_edges(const ReportedFeature& fa, const ReportedFeature& fb) const {
    const auto& ends_a = a_.edges()[fa.index].vertices;
    const auto& ends_b = b_.edges()[fb.index].vertices;
    const auto &x = a_.mesh().points, &y = b_.mesh().points;
    PredicateLadder ladder;
    ladder.floating = false;
    return is_zero(ContactDirection::cross({&x[ends_a[1]], &x[ends_a[0]]}, {&y[ends_b[1]], &y[ends_b[0]]}),
                   ladder);
  }
  void add_point(ReportedContact& contact, const RegionVertex& v, const ReportedFeature& fa,
                 const ReportedFeature& fb, const Vector3& normal) const {
    if (fa.dimension + fb.dimension > 2) return;
    if (fa.dimension == 1 && fb.dimension == 1 && are_parallel_edges(fa, fb)) return;
    ReportedPoint p;
    p.pair = pair_kind(fa.dimension, fb.dimension);
    if (fb.dimension == 2 || (fa.dimension != 2 && contact.b.dimension == 2))
      p.face_of = ReportedBody::b;
    else if (fa.dimension == 2 || contact.a.dimension == 2)
      p.face_of = ReportedBody::a;
    const bool on_a = p.face_of == ReportedBody::a;
    p.point = on_a ? v.on_b : v.on_a;
    p.foot = p.plane_point = on_a ? v.on_a : v.on_b;
    p.plane_normal = on_a                           ? a_.faces()[contact.a.index].normal
                     : p.face_of == ReportedBody::b ? b_.faces()[contact.b.index].normal
                                                    : normal;
    p.gap = gap_;
    const auto same = [&](const ReportedPoint& q) {
      return q.point == p.point && q.foot == p.foot && q.pair == p.pair;
    };
    if (std::any_of(contact.points.begin(), contact.points.end(), same)) return;
    const auto place = std::find_if(contact.points.begin(), contact.points.end(),
                                    [&](const ReportedPoint& q) { return less(p.point, q.point); });
    contact.points.insert(place, p);
  }

  const Polyhedron &a_, &b_;
  FeatureMap map_a_, map_b_;
  double gap_;
  std::map<std::pair<Key, Key>, ReportedContact> contacts_;
};

}  // namespace

ContactReport report_solids(const Polyhedron& a, const Polyhedron& b) {
  const SolidRelation relation = relate_solids(a.mesh(), b.mesh());
  ContactReport report;
  report.relation = relation.relation;
  report.squared_distance = relation.squared_distance;
  report.decided_by = relation.decided_by;
  ContactCollector collector(a, b, std::sqrt(relation.squared_distance));
  for (const auto& [t, s] : relation.nearest) collector.add(t, s);
  report.contacts = collector.contacts();
  return report;
}

}  // namespace ashlar
