#include "geometry/contacts/solid_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/any_solid/distance_minima.hpp"
#include "geometry/any_solid/solid_relation.hpp"
#include "geometry/exact/rounding_mode.hpp"
#include "geometry/lexicographic.hpp"

namespace ashlar {

namespace {

// Writes a minimum with the numbering of the report.
class MinimumWriter {
 public:
  MinimumWriter(const SolidFeatures& a, const SolidFeatures& b, const DistanceMinimum& minimum)
      : a_(a), b_(b), minimum_(minimum) {}

  [[nodiscard]] ReportedContact write() const {
    ReportedContact contact;
    contact.a = {minimum_.a.dimension, minimum_.a.index, {}};
    contact.b = {minimum_.b.dimension, minimum_.b.index, {}};
    contact.type = contact_type(minimum_.a.dimension, minimum_.b.dimension);
    contact.region_dimension = minimum_.dimension;
    contact.area = round_square_root(minimum_.squared_area.get_mpq_t());
    const Rational squared = dot_product(minimum_.w, minimum_.w);
    contact.squared_distance = round_to_nearest(squared.get_mpq_t());
    if (!is_zero(minimum_.normal)) contact.direction = round_unit_vector(minimum_.normal);
    const double gap = round_square_root(squared.get_mpq_t());
    for (const MinimumPoint& p : minimum_.points) contact.points.push_back(point(p, contact.direction, gap));
    std::stable_sort(contact.points.begin(), contact.points.end(),
                     [](const ReportedPoint& p, const ReportedPoint& q) {
                       return lexicographically_less(p.point, q.point);
                     });
    return contact;
  }

 private:
  [[nodiscard]] ReportedPoint point(const MinimumPoint& v, const Vector3& direction, double gap) const {
    ReportedPoint p;
    p.pair = pair_kind(v.a.dimension, v.b.dimension);
    if (v.b.dimension == 2 || (v.a.dimension != 2 && minimum_.b.dimension == 2))
      p.face_of = ReportedBody::b;
    else if (v.a.dimension == 2 || minimum_.a.dimension == 2)
      p.face_of = ReportedBody::a;
    const bool on_a = p.face_of == ReportedBody::a;
    const Vector3 of_a = round_to_nearest(v.on_a), of_b = round_to_nearest(difference(v.on_a, minimum_.w));
    p.point = on_a ? of_b : of_a;
    p.foot = p.plane_point = on_a ? of_a : of_b;
    p.plane_normal = direction;
    // A point of the mesh and the normal of the face define the plane more accurately.
    if (p.face_of) {
      const SolidFeatures& body = on_a ? a_ : b_;
      const int face = on_a ? minimum_.a.index : minimum_.b.index;
      p.plane_point = body.point(body.triangle_of_face(face)[0]);
      p.plane_normal = body.solid().faces()[face].normal;
    }
    p.gap = gap;
    return p;
  }

  const SolidFeatures &a_, &b_;
  const DistanceMinimum& minimum_;
};

// Separate from report_solids() so that no arithmetic is moved across the change of the rounding mode.
[[gnu::noinline]] ContactReport report_to_nearest(const Polyhedron& a, const Polyhedron& b,
                                                  const std::optional<double>& distance) {
  const SolidFeatures features_a(a), features_b(b);
  const SolidRelation relation = relate_solids(features_a, features_b);
  ContactReport report;
  report.relation = relation.relation;
  report.squared_distance = relation.squared_distance;
  report.decided_by = relation.decided_by;
  if (relation.relation == Relation::crossing) return report;
  const MinimumBound bound{distance, report.squared_distance, report.relation == Relation::touching};
  for (const DistanceMinimum& minimum :
       find_distance_minima(features_a, features_b, bound, report.decided_by))
    report.contacts.push_back(MinimumWriter(features_a, features_b, minimum).write());
  return report;
}

}  // namespace

ContactReport report_solids(const Polyhedron& a, const Polyhedron& b, const std::optional<double>& distance) {
  if (distance && (!(*distance >= 0.0) || std::isinf(*distance)))
    throw std::invalid_argument("contact distance must be finite and not negative");
  const NearestRounding nearest;
  return report_to_nearest(a, b, distance);
}

}  // namespace ashlar
