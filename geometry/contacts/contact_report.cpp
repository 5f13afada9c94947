#include "geometry/contacts/contact_report.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/contacts/solid_contacts.hpp"
#include "geometry/exact/rounding_mode.hpp"
#include "geometry/solid/rounded_convexity.hpp"

namespace ashlar {

namespace {

// True if the triangles of a face have all of some points.
bool has_points(const Polyhedron& solid, int face, const std::vector<int>& points) {
  const std::vector<int>& triangles = solid.faces()[face].triangles;
  return std::all_of(points.begin(), points.end(), [&](int point) {
    return std::any_of(triangles.begin(), triangles.end(), [&](int t) {
      const auto& corners = solid.mesh().triangles[t];
      return std::find(corners.begin(), corners.end(), point) != corners.end();
    });
  });
}

double polygon_area(const std::vector<RegionVertex>& points) {
  Vector3 twice = Vector3::Zero();
  const Vector3& o = points.front().on_a;
  for (std::size_t k = 2; k < points.size(); ++k) twice += (points[k - 1].on_a - o).cross(points[k].on_a - o);
  return 0.5 * twice.norm();
}

// Without negative zeros.
Vector3 opposite(const Vector3& v) {
  return Vector3::Zero() - v;
}

// The corner of a body that reaches farthest along a direction.
Vector3 farthest_corner(const ReportedSolid& body, const Vector3& direction) {
  const std::vector<Vector3>& x = body.shape()->corners();
  return *std::max_element(x.begin(), x.end(), [&](const Vector3& p, const Vector3& q) {
    return direction.dot(p) < direction.dot(q);
  });
}

// Writes the contact of one region in the features of the meshes.
class ContactWriter {
 public:
  ContactWriter(const ReportedSolid& a, const ReportedSolid& b, const ContactRegion& region,
                const Vector3& normal)
      : a_(a), b_(b), region_(region), normal_(normal) {}

  /// @param gap of all points; empty: each point has its own, relative to the plane normal to the contact direction
  /// at the end of the other body.
  [[nodiscard]] ReportedContact write(std::optional<double> gap) const {
    ReportedContact contact;
    contact.type = region_.type;
    contact.a = a_.feature(region_.a);
    contact.b = b_.feature(region_.b);
    contact.region_dimension = region_.dimension;
    if (region_.dimension == 2) contact.area = polygon_area(region_.points);
    for (const RegionVertex& v : region_.points) {
      ReportedPoint p = point(v);
      if (gap)
        p.gap = *gap;
      else if (p.face_of)
        move_to_end_plane(p);
      else
        p.gap = normal_.dot(p.point - p.foot);
      contact.points.push_back(p);
    }
    return contact;
  }

 private:
  [[nodiscard]] ReportedPoint point(const RegionVertex& v) const {
    ReportedPoint p;
    p.pair = v.pair();
    if (v.b.dimension == 2 || (v.a.dimension != 2 && region_.b.dimension == 2))
      p.face_of = ReportedBody::b;
    else if (v.a.dimension == 2 || region_.a.dimension == 2)
      p.face_of = ReportedBody::a;
    const bool on_a = p.face_of == ReportedBody::a;
    p.point = on_a ? v.on_b : v.on_a;
    p.foot = p.plane_point = on_a ? v.on_a : v.on_b;
    p.plane_normal = on_a ? opposite(normal_) : normal_;
    // A corner of the facet is exact.
    if (on_a && region_.a.index >= 0) p.plane_point = facet_corner(a_, region_.a);
    if (p.face_of == ReportedBody::b && region_.b.index >= 0) p.plane_point = facet_corner(b_, region_.b);
    return p;
  }
  void move_to_end_plane(ReportedPoint& p) const {
    p.plane_point = farthest_corner(p.face_of == ReportedBody::a ? a_ : b_, p.plane_normal);
    p.gap = p.plane_normal.dot(p.point - p.plane_point);
    p.foot = p.point - p.gap * p.plane_normal;
  }
  [[nodiscard]] static Vector3 facet_corner(const ReportedSolid& body, const ContactFeature& facet) {
    return body.shape()->corners()[body.shape()->facet(facet.index)[0]];
  }

  const ReportedSolid &a_, &b_;
  const ContactRegion& region_;
  const Vector3& normal_;
};

ConvexReport convex_report(const ContactRegion& region, const Vector3& normal, DirectionRule rule) {
  ConvexReport report{region.type, region.a_dimension, region.b_dimension, region.dimension, normal, rule,
                      {}};
  for (const RegionVertex& v : region.points) report.region.push_back(v.on_a);
  return report;
}

}  // namespace

ReportedSolid::ReportedSolid(Polyhedron solid) : solid_(std::move(solid)) {
  const NearestRounding nearest;
  is_hull_ = !solid_.convex();
  if (is_hull_ && !is_convex_but_for_rounding(solid_)) return;
  try {
    shape_ = ConvexShape::from_mesh(solid_.mesh());
  } catch (const std::invalid_argument&) {
    if (!is_hull_) throw;  // an exactly convex mesh is always a shape
  }
}

ReportedFeature ReportedSolid::feature(const ContactFeature& of_shape) const {
  ReportedFeature feature{of_shape.dimension, -1, {}};
  if (of_shape.index < 0) return feature;
  const std::vector<int>& source = shape_->source_points();
  if (of_shape.dimension == 0) {
    feature.index = source[of_shape.index];
  } else if (of_shape.dimension == 1) {
    const auto& [from, to] = shape_->edges()[of_shape.index].corners;
    feature.points = {source[from], source[to]};
    for (std::size_t e = 0; e < solid_.edges().size() && feature.index < 0; ++e) {
      const std::array<int, 2>& ends = solid_.edges()[e].vertices;
      if (std::is_permutation(ends.begin(), ends.end(), feature.points.begin()))
        feature.index = static_cast<int>(e);
    }
  } else {
    for (const int v : shape_->facet(of_shape.index)) feature.points.push_back(source[v]);
    const int triangle = shape_->source_triangles()[of_shape.index];
    // A facet of the hull may be made of two faces.
    if (triangle >= 0 && has_points(solid_, solid_.face_of_triangle()[triangle], feature.points))
      feature.index = solid_.face_of_triangle()[triangle];
  }
  if (feature.index >= 0) feature.points.clear();
  return feature;
}

ContactReport report_contact(const ReportedSolid& a, const ReportedSolid& b,
                             const std::optional<Resolution>& resolution) {
  if (a.shape() == nullptr || b.shape() == nullptr) {
    if (resolution && resolution->sine > 0.0) throw NotConvexError();
    ContactReport report = report_solids(
        a.solid(), b.solid(),
        resolution && resolution->distance != 0.0 ? std::optional(resolution->distance) : std::nullopt);
    report.resolution = resolution;
    return report;
  }
  const ConvexContact exact = classify(*a.shape(), *b.shape(), std::nullopt, {!resolution, false, true});
  ContactReport report;
  report.relation = exact.relation;
  report.squared_distance = exact.squared_distance;
  report.hull_of_a = a.is_hull();
  report.hull_of_b = b.is_hull();
  report.resolution = resolution;
  report.decided_by = exact.decided_by;
  for (const MinimalTranslation& m : exact.minimal_translations)
    report.minimal_translations.push_back(m.translation);

  if (resolution) {
    const ResolvedContact resolved = classify_at(*a.shape(), *b.shape(), *resolution);
    report.decided_by.filter += resolved.decided_by.filter;
    report.decided_by.exact += resolved.decided_by.exact;
    report.convex = convex_report(resolved.region, resolved.normal, resolved.rule);
    report.contacts = {ContactWriter(a, b, resolved.region, resolved.normal).write(std::nullopt)};
  } else {
    report.convex = convex_report(exact.region, exact.normal, exact.rule);
    if (exact.relation != Relation::crossing)
      report.contacts = {ContactWriter(a, b, exact.region, exact.normal).write(exact.gap)};
  }
  if (exact.relation == Relation::crossing) report.depth = -exact.gap;
  return report;
}

}  // namespace ashlar
