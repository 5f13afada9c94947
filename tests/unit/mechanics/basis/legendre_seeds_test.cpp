#include "mechanics/basis/legendre_seeds.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/solid/shapes.hpp"
#include "mechanics/basis/multi_index.hpp"

namespace ashlar::legendre_seeds_test {
namespace {

constexpr int order = 3;

/// Digits of the type that products and sums keep.
template <class Real>
constexpr double exact = 1e4 * unit_roundoff<Real>;

template <class Real>
class LegendreSeeds : public testing::Test {};
using Reals = testing::Types<ExtendedDouble, FiftyDigits>;
TYPED_TEST_SUITE(LegendreSeeds, Reals);

/// Moments of [-1, 1]^3, where the seeds are orthogonal.
template <class Real>
RealMatrix<Real> gram_of_cube() {
  const TriangleMesh cube = make_box({-1, -1, -1}, {1, 1, 1});
  RealPoints<Real> points;
  for (const Vector3& point : cube.points) points.push_back({Real(point[0]), Real(point[1]), Real(point[2])});
  return gram_matrix(legendre_moments(monomial_moments(points, cube, 2 * order), 2 * order), order);
}

template <class Real>
double difference(const Real& value, const Real& expected) {
  return std::abs(rounded(Real(value - expected)));
}

TYPED_TEST(LegendreSeeds, AreOrthogonalOverTheCube) {
  using Real = TypeParam;
  const RealMatrix<Real> gram = gram_of_cube<Real>();
  const auto exponents = monomial_exponents(order);
  for (Eigen::Index i = 0; i < gram.rows(); ++i) {
    const auto& [a, b, c] = exponents[static_cast<std::size_t>(i)];
    // The integral of L_k^2 from -1 to 1 is 2/(2k + 1).
    EXPECT_LT(difference(gram(i, i), Real(8) / Real((2 * a + 1) * (2 * b + 1) * (2 * c + 1))), exact<Real>);
    for (Eigen::Index j = 0; j < i; ++j) EXPECT_LT(difference(gram(i, j), Real(0)), exact<Real>);
  }
}

TYPED_TEST(LegendreSeeds, FactorAndInverseAreExact) {
  using Real = TypeParam;
  RealMatrix<Real> matrix(2, 2);
  matrix << Real(4), Real(0), Real(2), Real(10);  // L = (2, 0; 1, 3)
  Eigen::Index failed = 7;
  const RealMatrix<Real> lower = cholesky_factor(matrix, failed);
  EXPECT_EQ(failed, -1);
  EXPECT_LT(difference(lower(0, 0), Real(2)), exact<Real>);
  EXPECT_LT(difference(lower(1, 0), Real(1)), exact<Real>);
  EXPECT_LT(difference(lower(1, 1), Real(3)), exact<Real>);
  const RealMatrix<Real> inverse = inverse_of_lower(lower);
  EXPECT_LT(difference(inverse(1, 0), Real(-1) / Real(6)), exact<Real>);
  EXPECT_LT(difference(inverse(1, 1), Real(1) / Real(3)), exact<Real>);
  matrix(1, 1) = Real(1);  // 1 - 1^2 = 0: not positive
  (void)cholesky_factor(matrix, failed);
  EXPECT_EQ(failed, 1);
}

TYPED_TEST(LegendreSeeds, HaveTheValuesOfLegendrePolynomials) {
  using Real = TypeParam;
  const std::vector<Real> at_corner = seed_values<Real>({Real(1), Real(1), Real(1)}, order);
  for (const Real& value : at_corner) EXPECT_LT(difference(value, Real(1)), exact<Real>);
  // L_2(1/2) = -1/8, L_1(-1/4) = -1/4.
  const std::vector<Real> values = seed_values<Real>({Real(0.5), Real(-0.25), Real(0)}, order);
  EXPECT_LT(difference(values[static_cast<std::size_t>(monomial_index(2, 1, 0))], Real(1) / Real(32)),
            exact<Real>);
  EXPECT_LT(difference(values[static_cast<std::size_t>(monomial_index(0, 0, 2))], Real(-0.5)), exact<Real>);
}

TYPED_TEST(LegendreSeeds, AreDifferentiatedAndMultipliedAsPolynomials) {
  using Real = TypeParam;
  Eigen::Index failed = -1;
  const RealMatrix<Real> lower = cholesky_factor(gram_of_cube<Real>(), failed);
  const RealMatrix<Real> inverse = inverse_of_lower(lower);
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
  EXPECT_NEAR(rounded(weights.front()), 1.0 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(rounded(weights.back()), 2.0 / std::sqrt(15.0), 1e-15);
}

// Integrals of x^a y^b z^c over [-1, 1]^3 are 8/((a+1)(b+1)(c+1)) for even exponents; of absolute values no less.
TYPED_TEST(LegendreSeeds, MomentsAreOffByNoMoreThanTheirSizesSay) {
  using Real = TypeParam;
  constexpr int degree = 24;
  const TriangleMesh cube = make_box({-1, -1, -1}, {1, 1, 1});
  RealPoints<Real> points;
  for (const Vector3& point : cube.points) points.push_back({Real(point[0]), Real(point[1]), Real(point[2])});
  const std::vector<Real> moments = monomial_moments(points, cube, degree);
  const std::vector<double> sizes = moment_sizes(cube.points, cube, degree);
  const std::vector<Real> seeds = legendre_moments(moments, degree);
  const double size = legendre_size(sizes, degree);
  EXPECT_LT(difference(seeds.front(), Real(8)), exact<Real>);
  for (const auto& [a, b, c] : monomial_exponents(degree)) {
    const auto place = static_cast<std::size_t>(monomial_index(a, b, c));
    const bool even = a % 2 == 0 && b % 2 == 0 && c % 2 == 0;
    const Real expected = even ? Real(8) / Real((a + 1) * (b + 1) * (c + 1)) : Real(0);
    EXPECT_LE(difference(moments[place], expected), (3 * degree + 12) * unit_roundoff<Real> * sizes[place]);
    EXPECT_GE(sizes[place], rounded(expected) * (1.0 - 1e-12));
    if (place == 0) continue;
    EXPECT_LE(difference(seeds[place], Real(0)), (3 * degree + 12) * unit_roundoff<Real> * size);
  }
}

TEST(DoubleDoubles, AreRoundedAndConverted) {
  const FiftyDigits third = FiftyDigits(1) / FiftyDigits(3);
  const ExtendedDouble value = converted<ExtendedDouble>(third);
  EXPECT_EQ(rounded(value), 1.0 / 3.0);
  // 1/3 as a double is lower by 2^-54 / 3.
  EXPECT_NEAR(rounded(ExtendedDouble(value - 1.0 / 3.0)), 0x1p-54 / 3.0, 0x1p-106);
  EXPECT_EQ(rounded(ExtendedDouble(converted<ExtendedDouble>(value) - value)), 0.0);
}

}  // namespace
}  // namespace ashlar::legendre_seeds_test
