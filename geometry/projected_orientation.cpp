// Filter: with u = 2^-53, each difference has relative error <= u(1+small) and the determinant is a sum of
// three products of one difference with a 2x2 minor. Following Shewchuk's error analysis of orient3d (whose
// last row is a difference too; here it is exact, so the bound holds a fortiori) |computed - exact| <= (7 +
// 56 u) u * permanent. The constant 16 u doubles that so that the bound also holds when the permanent itself
// is rounded in any direction and in any rounding mode (each rounding error then is below 2u). Underflow is
// excluded by requiring the permanent to be normal and large.
#include "geometry/projected_orientation.hpp"

#include <CGAL/Mpzf.h>
#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace ashlar {
namespace {

int exact_orientation(const Vector3& w, const Vector3& a, const Vector3& b, const Vector3& c) {
  using Exact = CGAL::Mpzf;
  const Exact ux = Exact(b.x()) - Exact(a.x());
  const Exact uy = Exact(b.y()) - Exact(a.y());
  const Exact uz = Exact(b.z()) - Exact(a.z());
  const Exact vx = Exact(c.x()) - Exact(a.x());
  const Exact vy = Exact(c.y()) - Exact(a.y());
  const Exact vz = Exact(c.z()) - Exact(a.z());
  const Exact determinant = Exact(w.x()) * (uy * vz - uz * vy) + Exact(w.y()) * (uz * vx - ux * vz) +
                            Exact(w.z()) * (ux * vy - uy * vx);
  return static_cast<int>(CGAL::sign(determinant));
}

}  // namespace

int orientation_along(const Vector3& w, const Vector3& a, const Vector3& b, const Vector3& c,
                      PredicateCounts& counts) {
  const Vector3 u = b - a;
  const Vector3 v = c - a;
  const double determinant = w.x() * (u.y() * v.z() - u.z() * v.y()) +
                             w.y() * (u.z() * v.x() - u.x() * v.z()) +
                             w.z() * (u.x() * v.y() - u.y() * v.x());
  const double permanent = std::abs(w.x()) * (std::abs(u.y() * v.z()) + std::abs(u.z() * v.y())) +
                           std::abs(w.y()) * (std::abs(u.z() * v.x()) + std::abs(u.x() * v.z())) +
                           std::abs(w.z()) * (std::abs(u.x() * v.y()) + std::abs(u.y() * v.x()));
  constexpr double unit = std::numeric_limits<double>::epsilon();  // 2^-52 = 2 u
  const double bound = 16.0 * unit * permanent;
  constexpr double smallest =
      0x1p-900;  // far above where products of three could have lost bits to underflow
  if (permanent > smallest && permanent < std::numeric_limits<double>::infinity()) {
    if (determinant > bound) return ++counts.filter, 1;
    if (determinant < -bound) return ++counts.filter, -1;
  }
  ++counts.exact;
  return exact_orientation(w, a, b, c);
}

}  // namespace ashlar
