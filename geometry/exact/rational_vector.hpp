// Vectors of rational numbers, for the constructions behind exact answers. Only sources of this layer include
// it.
#pragma once

#include <gmpxx.h>

#include "geometry/exact/exact_rounding.hpp"
#include "geometry/exact/number_vector.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

using Rational = mpq_class;
using RationalVector = NumberVector<Rational>;

[[nodiscard]] inline RationalVector to_rational(const Vector3& p) {
  return {Rational(p.x()), Rational(p.y()), Rational(p.z())};
}

[[nodiscard]] inline RationalVector sum(const RationalVector& a, const RationalVector& b) {
  return {Rational(a.x + b.x), Rational(a.y + b.y), Rational(a.z + b.z)};
}

[[nodiscard]] inline RationalVector difference(const RationalVector& a, const RationalVector& b) {
  return {Rational(a.x - b.x), Rational(a.y - b.y), Rational(a.z - b.z)};
}

[[nodiscard]] inline RationalVector multiple(const RationalVector& a, const Rational& s) {
  return {Rational(a.x * s), Rational(a.y * s), Rational(a.z * s)};
}

[[nodiscard]] inline RationalVector cross_product(const RationalVector& a, const RationalVector& b) {
  return {Rational(a.y * b.z - a.z * b.y), Rational(a.z * b.x - a.x * b.z), Rational(a.x * b.y - a.y * b.x)};
}

[[nodiscard]] inline Rational dot_product(const RationalVector& a, const RationalVector& b) {
  return Rational(a.x * b.x + a.y * b.y + a.z * b.z);
}

[[nodiscard]] inline bool is_zero(const RationalVector& a) {
  return sgn(a.x) == 0 && sgn(a.y) == 0 && sgn(a.z) == 0;
}

/// Every coordinate correctly rounded.
[[nodiscard]] inline Vector3 round_to_nearest(const RationalVector& a) {
  return {round_to_nearest(a.x.get_mpq_t()), round_to_nearest(a.y.get_mpq_t()),
          round_to_nearest(a.z.get_mpq_t())};
}

/// a / |a|, every coordinate correctly rounded. @param a not zero.
[[nodiscard]] inline Vector3 round_unit_vector(const RationalVector& a) {
  const Rational squared_length = dot_product(a, a);
  Vector3 unit;
  for (int i = 0; i < 3; ++i) {
    const Rational& x = component(a, i);
    const Rational squared(x * x / squared_length);
    unit[i] = sgn(x) * round_square_root(squared.get_mpq_t());
  }
  return unit + Vector3::Zero();
}

}  // namespace ashlar
