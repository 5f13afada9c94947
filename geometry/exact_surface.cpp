#include "geometry/exact_surface.hpp"

#include <CGAL/Gmpq.h>
#include <CGAL/Mpzf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/exact_rounding.hpp"

namespace ashlar {
namespace {

// Integer times a power of two: sums and products of doubles without rounding and without overflow.
using Exact = CGAL::Mpzf;
using ExactVector = std::array<Exact, 3>;

// The analyser takes the limbs behind an offset pointer for lost.
// NOLINTBEGIN(clang-analyzer-cplusplus.NewDeleteLeaks)
ExactVector exact(const Vector3& p) {
  return {Exact(p.x()), Exact(p.y()), Exact(p.z())};
}

ExactVector operator-(const ExactVector& a, const ExactVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

ExactVector cross(const ExactVector& a, const ExactVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// NOLINTEND(clang-analyzer-cplusplus.NewDeleteLeaks)

// Squaring stays in range for components between these bounds.
Vector3 round_direction(ExactVector v) {
  constexpr int half_range = std::numeric_limits<double>::max_exponent / 2 - 1;
  const double upper = std::ldexp(1.0, half_range);
  const double lower = std::ldexp(1.0, -half_range);
  for (;;) {
    const Vector3 rounded(v[0].to_double(), v[1].to_double(), v[2].to_double());
    const double largest = rounded.cwiseAbs().maxCoeff();
    if (largest >= lower && largest <= upper) {
      // One component of exactly 1 keeps axis-parallel normals exact; adding zero turns -0 into 0.
      return (rounded / largest).normalized() + Vector3::Zero();
    }
    if (std::all_of(v.begin(), v.end(), [](const Exact& x) { return x.sign() == 0; })) return Vector3::Zero();
    const Exact factor(largest > upper ? lower : upper);
    for (Exact& x : v) x = x * factor;
  }
}

}  // namespace

// The signed volume between a triangle and the plane z = 0 is its projected area times its mean height.
double signed_volume(const TriangleMesh& mesh) {
  std::vector<ExactVector> points;
  points.reserve(mesh.points.size());
  for (const Vector3& p : mesh.points) points.push_back(exact(p));
  Exact sum(0);
  for (const auto& [i, j, k] : mesh.triangles) {
    const ExactVector& a = points[i];
    const ExactVector& b = points[j];
    const ExactVector& c = points[k];
    const Exact twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if (twice_area.sign() != 0) sum = sum + twice_area * (a[2] + b[2] + c[2]);
  }
  const CGAL::Gmpq volume = CGAL::Gmpq(sum) / 6;
  return round_to_nearest(volume.mpq());
}

Vector3 area_direction(const TriangleMesh& mesh, std::span<const int> triangles) {
  ExactVector sum{Exact(0), Exact(0), Exact(0)};
  for (const int t : triangles) {
    const auto& [i, j, k] = mesh.triangles[t];
    const ExactVector a = exact(mesh.points[i]);
    const ExactVector n = cross(exact(mesh.points[j]) - a, exact(mesh.points[k]) - a);
    for (int d = 0; d < 3; ++d) sum[d] = sum[d] + n[d];
  }
  return round_direction(std::move(sum));
}

}  // namespace ashlar
