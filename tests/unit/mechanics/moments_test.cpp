#include "mechanics/moments.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/gmp.hpp>
#include <cmath>
#include <random>

#include "geometry/shapes.hpp"

namespace ashlar {
namespace {

using Rational = boost::multiprecision::mpq_rational;

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
}  // namespace ashlar
