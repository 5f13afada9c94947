#include "mechanics/basis/moments.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/gmp.hpp>
#include <cmath>
#include <map>
#include <random>

#include "geometry/solid/shapes.hpp"
#include "support/sample_solids.hpp"

namespace ashlar::moments_test {
namespace {

// Without expressions that hold references to temporary values.
using Rational =
    boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;

double factorial(int n) {
  return n <= 1 ? 1.0 : n * factorial(n - 1);
}

TriangleMesh unit_tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{{0, 2, 1}}, {{0, 1, 3}}, {{0, 3, 2}}, {{1, 2, 3}}}};
}

TEST(Moments, UnitTetrahedronToDegree24) {
  const auto values = moments(unit_tetrahedron(), 24);
  for (const auto& [a, b, c] : monomial_exponents(24)) {
    const double exact = factorial(a) * factorial(b) * factorial(c) / factorial(a + b + c + 3);
    EXPECT_NEAR(values[static_cast<std::size_t>(monomial_index(a, b, c))] / exact, 1.0, 1e-14) << a << b << c;
  }
}

// The integral over a box is a product of one-dimensional ones, taken here in exact rationals.
void expect_box_moments(const Vector3& low, const Vector3& high, int degree) {
  const auto values = moments(make_box(low, high), degree);
  const auto power = [](double x, int k) {
    Rational value = 1;
    for (int i = 0; i < k; ++i) value *= Rational(x);
    return value;
  };
  for (const auto& exponents : monomial_exponents(degree)) {
    Rational exact = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const int k = exponents[static_cast<std::size_t>(axis)] + 1;
      exact *= (power(high[axis], k) - power(low[axis], k)) / k;
    }
    const double value =
        values[static_cast<std::size_t>(monomial_index(exponents[0], exponents[1], exponents[2]))];
    const Rational error = abs(Rational(value) - exact);
    EXPECT_LE(error, abs(exact) * Rational(1.2e-16)) << exponents[0] << exponents[1] << exponents[2];
  }
}

TEST(Moments, BoxesNearAndFarThinAndThick) {
  expect_box_moments({-1, -2, -3}, {1, 2, 3}, 16);  // odd moments vanish exactly
  expect_box_moments({0.1, 0.2, 0.3}, {1.7, 0.9, 2.5}, 24);
  expect_box_moments({1048576.1, -0.3, 7}, {1048577.3, 0.1, 7.7}, 12);
  expect_box_moments({0, 0, 0}, {1073741824.0, 1, std::ldexp(1.0, -30)}, 12);
}

using Point = std::array<Rational, 3>;
using Polynomial = std::map<std::array<int, 3>, Rational>;  // in the coordinates (u, v, w) of a tetrahedron

/// The polynomial times u p + v q + w r, one coordinate of the tetrahedron's points.
Polynomial times_coordinate(const Polynomial& polynomial, const std::array<Rational, 3>& corners) {
  Polynomial product;
  for (const auto& [exponents, value] : polynomial) {
    for (std::size_t k = 0; k < 3; ++k) {
      auto next = exponents;
      ++next[k];
      product[next] += value * corners[k];
    }
  }
  return product;
}

/// Integral of X^a Y^b Z^c over a solid by multiplying out on each tetrahedron with the origin, in rationals:
/// integral of u^i v^j w^k over the unit tetrahedron is i! j! k! / (i+j+k+3)!.
Rational exact_moment(const TriangleMesh& mesh, const std::array<int, 3>& exponents) {
  const auto whole_factorial = [](int n) {
    Rational value = 1;
    for (int k = 2; k <= n; ++k) value *= k;
    return value;
  };
  Rational sum = 0;
  for (const auto& triangle : mesh.triangles) {
    std::array<Point, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis)
        corners[k][static_cast<std::size_t>(axis)] =
            Rational(mesh.points[static_cast<std::size_t>(triangle[k])][axis]);
    }
    const auto& [p, q, r] = corners;
    const Rational determinant = p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) +
                                 p[2] * (q[0] * r[1] - q[1] * r[0]);
    Polynomial polynomial = {{{0, 0, 0}, determinant}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < exponents[axis]; ++k)
        polynomial = times_coordinate(polynomial, {p[axis], q[axis], r[axis]});
    }
    for (const auto& [e, value] : polynomial)
      sum += value * whole_factorial(e[0]) * whole_factorial(e[1]) * whole_factorial(e[2]) /
             whole_factorial(e[0] + e[1] + e[2] + 3);
  }
  return sum;
}

void expect_exact_moments(const TriangleMesh& mesh, int degree) {
  const auto values = moments(mesh, degree);
  for (const auto& exponents : monomial_exponents(degree)) {
    const Rational exact = exact_moment(mesh, exponents);
    const double value =
        values[static_cast<std::size_t>(monomial_index(exponents[0], exponents[1], exponents[2]))];
    const Rational error = abs(Rational(value) - exact);
    EXPECT_LE(error, abs(exact) * Rational(1.2e-16)) << exponents[0] << exponents[1] << exponents[2];
  }
}

TEST(Moments, TwoHundredRandomMeshesConvexAndNot) {
  std::mt19937_64 random(97);
  const auto number = [&] { return static_cast<double>(random() >> 40) * 0x1p-23 - 1.0; };
  for (int trial = 0; trial < 200; ++trial) {
    TriangleMesh mesh;
    if (trial % 2 == 0) {
      std::vector<Vector3> points;
      points.reserve(8);
      for (int k = 0; k < 8; ++k) points.emplace_back(number(), number(), number());
      mesh = make_convex_hull(points);
    } else {
      // A prism over an L, sheared: closed and not convex for any shear.
      mesh = test_support::l_shaped_prism().mesh();
      const double a = number(), b = number(), c = number();
      for (Vector3& point : mesh.points)
        point = Vector3(point.x() + a * point.y() + b * point.z(), point.y() + c * point.z(), point.z());
    }
    const double needle = trial % 5 == 1 ? 0x1p30 : trial % 5 == 2 ? 0x1p-30 : 1.0;
    const double offset = trial % 3 == 1 ? 0x1p20 : 0.0;
    for (Vector3& point : mesh.points) {
      point.x() *= needle;
      point += Vector3::Constant(offset);
    }
    expect_exact_moments(mesh, trial < 6 ? 6 : 3);
  }
}

TEST(Moments, IndexFollowsTheOrderOfTheExponents) {
  int place = 0;
  for (const auto& [a, b, c] : monomial_exponents(9)) EXPECT_EQ(monomial_index(a, b, c), place++);
  EXPECT_EQ(place, polynomial_count(9));
}

TEST(Moments, RefusesADegreeOutOfRange) {
  EXPECT_THROW((void)moments(unit_tetrahedron(), -1), std::invalid_argument);
  EXPECT_THROW((void)moments(unit_tetrahedron(), 61), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::moments_test
