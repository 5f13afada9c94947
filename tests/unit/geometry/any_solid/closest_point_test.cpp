#include "geometry/any_solid/closest_point.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include "geometry/solid/shapes.hpp"
#include "support/exact_numbers.hpp"
#include "support/sample_meshes.hpp"

namespace ashlar::closest_point_test {
namespace {

// Brute force in rational numbers: the nearest of all points of all triangles.
using Exact = std::array<mpq_class, 3>;

Exact exact(const Vector3& p) {
  return {mpq_class(p.x()), mpq_class(p.y()), mpq_class(p.z())};
}
Exact operator-(const Exact& p, const Exact& q) {
  return {mpq_class(p[0] - q[0]), mpq_class(p[1] - q[1]), mpq_class(p[2] - q[2])};
}
mpq_class dot(const Exact& p, const Exact& q) {
  return mpq_class(p[0] * q[0] + p[1] * q[1] + p[2] * q[2]);
}
Exact combination(const Exact& o, const mpq_class& s, const Exact& u, const mpq_class& t, const Exact& v) {
  Exact result;
  for (int i = 0; i < 3; ++i) result[i] = o[i] + s * u[i] + t * v[i];
  return result;
}

Exact nearest_on_segment(const Exact& x, const Exact& a, const Exact& b) {
  const Exact u = b - a;
  mpq_class t(dot(x - a, u) / dot(u, u));
  t = std::max(mpq_class(0), std::min(mpq_class(1), t));
  return combination(a, t, u, 0, u);
}

Exact nearest_on_triangle(const Exact& x, const Exact& a, const Exact& b, const Exact& c) {
  const Exact u = b - a, v = c - a, d = x - a;
  const mpq_class uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), du = dot(d, u), dv = dot(d, v);
  const mpq_class determinant(uu * vv - uv * uv), s((du * vv - dv * uv) / determinant),
      t((dv * uu - du * uv) / determinant);
  if (s >= 0 && t >= 0 && s + t <= 1) return combination(a, s, u, t, v);
  Exact best;
  mpq_class least(-1);
  for (const Exact& p :
       {nearest_on_segment(x, a, b), nearest_on_segment(x, b, c), nearest_on_segment(x, c, a)}) {
    const mpq_class squared = dot(x - p, x - p);
    if (least >= 0 && squared >= least) continue;
    least = squared;
    best = p;
  }
  return best;
}

bool is_on_segment(const Exact& p, const Exact& a, const Exact& b) {
  const Exact nearest = nearest_on_segment(p, a, b);
  return nearest == p;
}

bool is_correctly_rounded(double value, const mpq_class& exact) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const mpq_class error(abs(mpq_class(value) - exact));
  return error <= abs(mpq_class(std::nextafter(value, infinity)) - exact) &&
         error <= abs(mpq_class(std::nextafter(value, -infinity)) - exact);
}

struct Expected {
  mpq_class squared;
  std::array<int, 2> feature{3, 0};  // dimension and index, the lowest one
  Exact point;
};

Expected brute_force(const Polyhedron& solid, const Vector3& query) {
  const Exact x = exact(query);
  Expected best;
  best.squared = -1;
  for (std::size_t t = 0; t < solid.mesh().triangles.size(); ++t) {
    const auto& [i, j, k] = solid.mesh().triangles[t];
    const auto& points = solid.mesh().points;
    const Exact p = nearest_on_triangle(x, exact(points[i]), exact(points[j]), exact(points[k]));
    const mpq_class squared = dot(x - p, x - p);
    if (best.squared >= 0 && squared > best.squared) continue;
    std::array<int, 2> feature{2, solid.face_of_triangle()[t]};
    for (int e = static_cast<int>(solid.edges().size()) - 1; e >= 0; --e) {
      const auto& [from, to] = solid.edges()[e].vertices;
      if (is_on_segment(p, exact(points[from]), exact(points[to]))) feature = {1, e};
    }
    for (const int v : solid.corners())
      if (exact(points[v]) == p) feature = {0, v};
    if (best.squared >= 0 && squared == best.squared && feature >= best.feature) continue;
    best = {squared, feature, p};
  }
  return best;
}

void expect_closest(const ClosestPointFinder& finder, const Vector3& query) {
  const Expected expected = brute_force(finder.solid(), query);
  const ClosestPoint found = finder.find(query);
  const std::array<int, 2> feature{found.feature.dimension, found.feature.index};
  EXPECT_EQ(feature, expected.feature) << query.transpose();
  EXPECT_TRUE(is_correctly_rounded(found.squared_distance, expected.squared)) << query.transpose();
  for (int i = 0; i < 3; ++i)
    EXPECT_TRUE(is_correctly_rounded(found.point[i], expected.point[i])) << query.transpose();
  EXPECT_EQ(found.place == PointPlace::on_surface, expected.squared == 0) << query.transpose();
}

double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

TEST(ClosestPoint, IsThatOfBruteForceOnALattice) {
  // Half and quarter steps: most points are equally near to several features.
  for (const TriangleMesh& mesh : {test_support::make_l_prism(), test_support::make_frame(),
                                   test_support::make_divided_cube(2), test_support::make_dented_cube(0.5)}) {
    const ClosestPointFinder finder{Polyhedron(mesh)};
    for (int x = -2; x <= 9; ++x)
      for (int y = -2; y <= 9; ++y)
        for (int z = -2; z <= 6; z += 2) expect_closest(finder, Vector3(x, y, z) / 4.0);
  }
}

TEST(ClosestPoint, IsThatOfBruteForceAtRandom) {
  std::mt19937_64 random(11);
  TriangleMesh mesh = make_sphere(Vector3::Zero(), 1.0, 2);
  for (Vector3& p : mesh.points) p *= 1.0 + 0.2 * uniform(random);
  const ClosestPointFinder finder{Polyhedron(mesh)};
  std::array<int, 3> seen{};
  for (int k = 0; k < 150; ++k) {
    const Vector3 x =
        3.0 * Vector3(uniform(random), uniform(random), uniform(random)) - Vector3::Constant(1.5);
    expect_closest(finder, x);
    ++seen.at(static_cast<std::size_t>(finder.find(x).feature.dimension));
    // A point of the surface but for rounding.
    expect_closest(finder, finder.find(x).point);
  }
  for (const int count : seen) EXPECT_GT(count, 5);
}

TEST(ClosestPoint, KnowsInsideFromOutside) {
  const ClosestPointFinder l{Polyhedron(test_support::make_l_prism())},
      frame{Polyhedron(test_support::make_frame())}, dent{Polyhedron(test_support::make_dented_cube(0.5))};
  std::mt19937_64 random(12);
  for (int k = 0; k < 4000; ++k) {
    const Vector3 x =
        4.0 * Vector3(uniform(random), uniform(random), uniform(random)) - Vector3::Constant(0.5);
    const auto is_in = [](double t, double low, double high) { return low < t && t < high; };
    const bool in_height = is_in(x.z(), 0, 1);
    const bool in_l = in_height && is_in(x.x(), 0, 2) && is_in(x.y(), 0, 2) && (x.x() < 1 || x.y() < 1);
    const bool in_frame =
        in_height && is_in(x.x(), 0, 3) && is_in(x.y(), 0, 3) && !(is_in(x.x(), 1, 2) && is_in(x.y(), 1, 2));
    // The dent is the pyramid over the top down to its middle at half height: |x - 1/2|, |y - 1/2| < z - 1/2.
    const double from_middle = std::max(std::abs(x.x() - 0.5), std::abs(x.y() - 0.5));
    const bool in_dent_cube = in_height && from_middle < 0.5 && x.z() - 0.5 < from_middle;
    EXPECT_EQ(l.find(x).place, in_l ? PointPlace::inside : PointPlace::outside) << x.transpose();
    EXPECT_EQ(frame.find(x).place, in_frame ? PointPlace::inside : PointPlace::outside) << x.transpose();
    EXPECT_EQ(dent.find(x).place, in_dent_cube ? PointPlace::inside : PointPlace::outside) << x.transpose();
  }
}

TEST(ClosestPoint, HoldsForNumbersOutOfTheRangeOfFilters) {
  for (const double scale : {0x1p-300, 0x1p300}) {
    TriangleMesh mesh = test_support::make_l_prism();
    for (Vector3& p : mesh.points) p *= scale;
    const ClosestPointFinder finder{Polyhedron(mesh)};
    const ClosestPoint found = finder.find(scale * Vector3(1.5, 1.25, 0.5));
    EXPECT_EQ(found.point, scale * Vector3(1.5, 1, 0.5));
    EXPECT_EQ(found.squared_distance, 0.0625 * scale * scale);
    EXPECT_EQ(found.feature.dimension, 2);
    EXPECT_EQ(found.place, PointPlace::outside);
  }
}

TEST(ClosestPoint, NotFinite) {
  const ClosestPointFinder finder{Polyhedron(test_support::make_l_prism())};
  EXPECT_THROW(static_cast<void>(finder.find({0, 0, std::numeric_limits<double>::quiet_NaN()})),
               std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::closest_point_test
