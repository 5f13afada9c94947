#include "geometry/cutting/flat_view.hpp"

#include <algorithm>
#include <cmath>

namespace ashlar {
namespace {

const Integer& coordinate(const ExactPoint& point, int axis) {
  return axis == 0 ? point.x : axis == 1 ? point.y : point.z;
}

/// Rounding preserves the order, so that integers are needed only for equal doubles.
int compare_along(const ExactPoint& a, const ExactPoint& b, int axis) {
  if (a.rounded[axis] != b.rounded[axis]) return a.rounded[axis] < b.rounded[axis] ? -1 : 1;
  return sgn(Integer(coordinate(a, axis) * b.w - coordinate(b, axis) * a.w));
}

}  // namespace

FlatView::FlatView(const ExactPlane& plane) {
  const std::array<Integer, 4>& of = plane.coefficients();
  for (int k = 1; k < 3; ++k)
    if (mpz_cmpabs(of[static_cast<std::size_t>(k)].get_mpz_t(),
                   of[static_cast<std::size_t>(axis_)].get_mpz_t()) > 0)
      axis_ = k;
  sense_ = sgn(of[static_cast<std::size_t>(axis_)]);
}

int FlatView::turn(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) const {
  if (const int quick = quick_turn(a.rounded, b.rounded, c.rounded)) return quick;
  const int u = (axis_ + 1) % 3, v = (axis_ + 2) % 3;
  const auto minor = [&](const ExactPoint& p, const ExactPoint& q) {
    return Integer(coordinate(p, u) * coordinate(q, v) - coordinate(p, v) * coordinate(q, u));
  };
  const Integer determinant = a.w * minor(b, c) - b.w * minor(a, c) + c.w * minor(a, b);
  return sense_ * sgn(determinant);
}

// Each coordinate has an error u, each difference u more, products and their difference two more: less than 12 u
// times the largest coordinate times the sum of the differences. 0: undecided.
int FlatView::quick_turn(const Vector3& a, const Vector3& b, const Vector3& c) const {
  const int u = (axis_ + 1) % 3, v = (axis_ + 2) % 3;
  const double p = b[u] - a[u], q = b[v] - a[v], r = c[u] - a[u], s = c[v] - a[v];
  const double value = p * s - q * r;
  const double largest =
      std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff()});
  const double bound =
      12.0 * 0x1p-53 * largest * (std::abs(p) + std::abs(q) + std::abs(r) + std::abs(s)) + 0x1p-1000;
  return value > bound ? sense_ : value < -bound ? -sense_ : 0;
}

int FlatView::compare(const ExactPoint& a, const ExactPoint& b) const {
  const int first = compare_along(a, b, (axis_ + 1) % 3);
  return first != 0 ? first : compare_heights(a, b);
}

int FlatView::compare_heights(const ExactPoint& a, const ExactPoint& b) const {
  return compare_along(a, b, (axis_ + 2) % 3);
}

bool FlatView::ray_meets(const ExactPoint& from, const ExactPoint& a, const ExactPoint& b) const {
  const bool a_above = compare_heights(a, from) > 0, b_above = compare_heights(b, from) > 0;
  return a_above != b_above && turn(a, b, from) * sense_ == (b_above ? 1 : -1);
}

std::array<Rational, 2> FlatView::seen(const ExactPoint& point) const {
  std::array<Rational, 2> result = {Rational(coordinate(point, (axis_ + 1) % 3), point.w),
                                    Rational(coordinate(point, (axis_ + 2) % 3), point.w)};
  for (Rational& number : result) number.canonicalize();
  if (sense_ < 0) std::swap(result[0], result[1]);
  return result;
}

Rational FlatView::doubled_area(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) const {
  const std::array<Rational, 2> p = seen(a), q = seen(b), r = seen(c);
  return Rational((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
}

}  // namespace ashlar
