#include "geometry/any_solid/flat_projection.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace ashlar {

// Conversion truncates, with an error of less than a unit in the last place, or less than the smallest number.
Coordinate coordinate(Rational exact, bool is_double) {
  const double value = exact.get_d();
  const double error = is_double || sgn(exact) == 0 ? 0.0
                                                    : 4.0 * TrackedNumber::unit_roundoff * std::abs(value) +
                                                          std::numeric_limits<double>::denorm_min();
  return {std::move(exact), {value, error}};
}

double least_value(const TrackedNumber& n) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return n.error == 0.0 ? n.value : std::nextafter(n.value - 2.0 * n.error, -infinity);
}

double greatest_value(const TrackedNumber& n) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return n.error == 0.0 ? n.value : std::nextafter(n.value + 2.0 * n.error, infinity);
}

int PlaneSigns::turn(const PlanePoint& p, const PlanePoint& q, const PlanePoint& r) const {
  if (floating_) {
    const TrackedNumber value = (q.u.tracked - p.u.tracked) * (r.v.tracked - p.v.tracked) -
                                (q.v.tracked - p.v.tracked) * (r.u.tracked - p.u.tracked);
    if (const int sign = certain_sign(value); sign != unknown_sign) return sign;
  }
  ++counts_.exact;
  return sgn(Rational((q.u.exact - p.u.exact) * (r.v.exact - p.v.exact) -
                      (q.v.exact - p.v.exact) * (r.u.exact - p.u.exact)));
}

int PlaneSigns::compare(const Coordinate& x, const Coordinate& y) const {
  if (floating_)
    if (const int sign = certain_sign(x.tracked - y.tracked); sign != unknown_sign) return sign;
  ++counts_.exact;
  return cmp(x.exact, y.exact);
}

bool PlaneSigns::is_between(const PlanePoint& p, const PlanePoint& q, const PlanePoint& x) const {
  const int along_u = compare(p.u, q.u);
  if (along_u != 0) return compare(p.u, x.u) == along_u && compare(x.u, q.u) == along_u;
  const int along_v = compare(p.v, q.v);
  return compare(p.v, x.v) == along_v && compare(x.v, q.v) == along_v;
}

// Numbers of the projection are quotients, which NumericRange does not protect from underflow: cases where it could
// matter are left to the exact rung. Underflow of an operation loses less than 2^-1074.
int PlaneSigns::certain_sign(const TrackedNumber& value) const {
  constexpr double underflow = 0x1p-1000;
  if (std::abs(value.value) <= value.error * (1.0 + 0x1p-29) + underflow) return unknown_sign;
  ++counts_.filter;
  return value.value > 0.0 ? 1 : -1;
}

FlatProjection::FlatProjection(const RationalVector& direction, bool coplanar) : coplanar_(coplanar) {
  const RationalVector& d = direction;
  const Vector3 size(std::abs(d.x.get_d()), std::abs(d.y.get_d()), std::abs(d.z.get_d()));
  size.maxCoeff(&dropped_);
  for (int i = 0; i < 3 && sgn(component(d, dropped_)) == 0; ++i) dropped_ = i;
  first_ = (dropped_ + 1) % 3;
  second_ = (dropped_ + 2) % 3;
  const Rational& along = component(d, dropped_);
  if (sgn(along) < 0) std::swap(first_, second_);
  if (!coplanar_) {
    first_slope_ = component(d, first_) / along;
    second_slope_ = component(d, second_) / along;
  }
  // A face across d and its image differ by the cosine between their planes, |along| / |d|: the image on
  // the coordinate plane is larger if it is made along d, smaller if it is made along the axis.
  squared_scale_ = along * along / dot_product(d, d);
  if (coplanar_) squared_scale_ = 1 / squared_scale_;
}

Coordinate FlatProjection::project(const Vector3& x, int axis, const Rational& slope) const {
  if (sgn(slope) == 0) return coordinate(Rational(x[axis]), true);
  return coordinate(Rational(Rational(x[axis]) - Rational(x[dropped_]) * slope), false);
}

}  // namespace ashlar
