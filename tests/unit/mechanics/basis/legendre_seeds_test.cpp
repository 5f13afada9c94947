#include "mechanics/basis/legendre_seeds.hpp"

#include <gtest/gtest.h>

#include "geometry/solid/shapes.hpp"
#include "mechanics/basis/multi_index.hpp"

namespace ashlar {
namespace {

constexpr int order = 3;

/// Moments of [-1, 1]^3, where the seeds are orthogonal.
RealMatrix gram_of_cube() {
  const TriangleMesh cube = make_box({-1, -1, -1}, {1, 1, 1});
  RealPoints points;
  for (const Vector3& point : cube.points) points.push_back({Real(point[0]), Real(point[1]), Real(point[2])});
  return gram_matrix(monomial_moments(points, cube, 2 * order), order);
}

double difference(const Real& value, const Real& expected) {
  return std::abs(static_cast<double>(Real(value - expected)));
}

TEST(LegendreSeeds, AreOrthogonalOverTheCube) {
  const RealMatrix gram = gram_of_cube();
  const auto exponents = monomial_exponents(order);
  for (Eigen::Index i = 0; i < gram.rows(); ++i) {
    const auto& [a, b, c] = exponents[static_cast<std::size_t>(i)];
    // The integral of L_k^2 from -1 to 1 is 2/(2k + 1).
    EXPECT_LT(difference(gram(i, i), Real(8) / Real((2 * a + 1) * (2 * b + 1) * (2 * c + 1))), 1e-45);
    for (Eigen::Index j = 0; j < i; ++j) EXPECT_LT(difference(gram(i, j), Real(0)), 1e-45);
  }
}

TEST(LegendreSeeds, FactorAndInverseAreExactTo50Digits) {
  RealMatrix matrix(2, 2);
  matrix << Real(4), Real(0), Real(2), Real(10);  // L = (2, 0; 1, 3)
  Eigen::Index failed = 7;
  const RealMatrix lower = cholesky_factor(matrix, failed);
  EXPECT_EQ(failed, -1);
  EXPECT_LT(difference(lower(0, 0), Real(2)), 1e-45);
  EXPECT_LT(difference(lower(1, 0), Real(1)), 1e-45);
  EXPECT_LT(difference(lower(1, 1), Real(3)), 1e-45);
  const RealMatrix inverse = inverse_of_lower(lower);
  EXPECT_LT(difference(inverse(1, 0), Real(-1) / Real(6)), 1e-45);
  EXPECT_LT(difference(inverse(1, 1), Real(1) / Real(3)), 1e-45);
  matrix(1, 1) = Real(1);  // 1 - 1^2 = 0: not positive
  (void)cholesky_factor(matrix, failed);
  EXPECT_EQ(failed, 1);
}

TEST(LegendreSeeds, HaveTheValuesOfLegendrePolynomials) {
  const std::vector<Real> at_corner = seed_values({Real(1), Real(1), Real(1)}, order);
  for (const Real& value : at_corner) EXPECT_LT(difference(value, Real(1)), 1e-45);
  // L_2(1/2) = -1/8, L_1(-1/4) = -1/4.
  const std::vector<Real> values = seed_values({Real(0.5), Real(-0.25), Real(0)}, order);
  EXPECT_LT(difference(values[static_cast<std::size_t>(monomial_index(2, 1, 0))], Real(1) / Real(32)), 1e-45);
  EXPECT_LT(difference(values[static_cast<std::size_t>(monomial_index(0, 0, 2))], Real(-0.5)), 1e-45);
}

TEST(LegendreSeeds, AreDifferentiatedAndMultipliedAsPolynomials) {
  Eigen::Index failed = -1;
  const RealMatrix lower = cholesky_factor(gram_of_cube(), failed);
  const RealMatrix inverse = inverse_of_lower(lower);
  // phi = sqrt((2k + 1)/2) L_k in each variable. phi_x = sqrt(3) phi_1 x, so d phi_x/dx = sqrt(3) phi_1.
  const Eigen::MatrixXd derivative = derivative_matrix(lower, inverse, order, 0);
  EXPECT_NEAR(derivative(monomial_index(1, 0, 0), 0), std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(derivative.row(monomial_index(0, 1, 0)).norm(), 0.0, 1e-15);
  // d L_2/dx = 3 L_1: weight sqrt(5) 3/sqrt(3).
  EXPECT_NEAR(derivative(monomial_index(2, 0, 0), monomial_index(1, 0, 0)), std::sqrt(15.0), 1e-14);
  // x phi_x = sqrt(3) (1/3 + 2/3 L_2) phi_1 = phi_1/sqrt(3) + 2/sqrt(15) phi_xx.
  const int xx = monomial_index(2, 0, 0);
  const auto weights =
      multiplied(lower, inverse, monomial_exponents(order), {0, monomial_index(1, 0, 0), 0, xx});
  EXPECT_NEAR(static_cast<double>(weights.front()), 1.0 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(static_cast<double>(weights.back()), 2.0 / std::sqrt(15.0), 1e-15);
}

}  // namespace
}  // namespace ashlar
