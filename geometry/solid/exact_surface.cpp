#include "geometry/solid/exact_surface.hpp"

#include <CGAL/Gmpq.h>
#include <CGAL/Mpzf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/exact/direction_predicates.hpp"
#include "geometry/exact/exact_rounding.hpp"
#include "geometry/exact/number_triple.hpp"
#include "geometry/exact/rounding_mode.hpp"

namespace ashlar {
namespace {

// Integer times a power of two: sums and products of doubles without rounding and without overflow.
using Exact = CGAL::Mpzf;
using ExactVector = NumberTriple<Exact>;

// The same with the constructors of the filters' number types.
// NOLINTNEXTLINE(bugprone-exception-escape): CGAL declares its moves noexcept although they may allocate
struct DyadicNumber : Exact {
  explicit DyadicNumber(double a) : Exact(a) {}
  DyadicNumber(Exact a) : Exact(std::move(a)) {}
  static DyadicNumber difference(double a, double b) { return Exact(a) - Exact(b); }
};

// The analyser considers the limbs behind an offset pointer as leaked.
// NOLINTBEGIN(clang-analyzer-cplusplus.NewDeleteLeaks)
ExactVector exact(const Vector3& p) {
  return {Exact(p.x()), Exact(p.y()), Exact(p.z())};
}

ExactVector operator-(const ExactVector& a, const ExactVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
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

namespace {

// Six times the volume: the signed volume between a triangle and the plane z = 0 is its projected area times
// its mean height.
template <class N>
N six_volumes(const TriangleMesh& mesh) {
  N sum(0.0);
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3 &a = mesh.points[i], &b = mesh.points[j], &c = mesh.points[k];
    const N twice_area = N::difference(b[0], a[0]) * N::difference(c[1], a[1]) -
                         N::difference(c[0], a[0]) * N::difference(b[1], a[1]);
    sum = sum + twice_area * (N(a[2]) + N(b[2]) + N(c[2]));
  }
  return sum;
}

// Separate from signed_volume() so that no arithmetic is moved across the change of the rounding mode.
[[gnu::noinline]] std::optional<double> quick_volume(const TriangleMesh& mesh) {
  NumericRange range;
  for (const Vector3& p : mesh.points)
    for (int d = 0; d < 3; ++d) range.include(p[d]);
  if (!range.safe()) return std::nullopt;
  const std::optional<DoubleDouble> volume = quotient(six_volumes<DoubleDouble>(mesh), DoubleDouble(6.0));
  return volume ? rounded(*volume) : std::nullopt;
}

}  // namespace

double signed_volume(const TriangleMesh& mesh) {
  {
    const NearestRounding nearest;
    if (const auto volume = quick_volume(mesh)) return *volume;
  }
  const CGAL::Gmpq volume = CGAL::Gmpq(six_volumes<DyadicNumber>(mesh)) / 6;
  return round_to_nearest(volume.mpq());
}

Vector3 area_direction(const TriangleMesh& mesh, std::span<const int> triangles) {
  ExactVector sum{Exact(0), Exact(0), Exact(0)};
  for (const int t : triangles) {
    const auto& [i, j, k] = mesh.triangles[t];
    const ExactVector a = exact(mesh.points[i]);
    ExactVector n = cross(exact(mesh.points[j]) - a, exact(mesh.points[k]) - a);
    if (triangles.size() == 1) return round_direction(std::move(n));
    for (int d = 0; d < 3; ++d) sum[d] = sum[d] + n[d];
  }
  return round_direction(std::move(sum));
}

}  // namespace ashlar
