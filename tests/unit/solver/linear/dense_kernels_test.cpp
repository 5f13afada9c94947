#include "solver/linear/dense_kernels.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <limits>

namespace ashlar::dense_kernels_test {
namespace {

template <class T>
class DenseKernels : public testing::Test {
 protected:
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
  /// Entries between -1 and 1, by a formula.
  static Matrix values(int rows, int columns, double phase) {
    return Matrix::NullaryExpr(rows, columns, [&](Eigen::Index r, Eigen::Index c) {
      return static_cast<T>(
          std::sin(phase + 1.7 * static_cast<double>(r * r) + 0.9 * static_cast<double>(c)));
    });
  }
  /// Symmetric, with eigenvalues from 1 up.
  static Matrix positive(int n) {
    const Matrix rows = values(3, n, 0.3);
    return rows.transpose() * rows + Matrix::Identity(n, n);
  }
  static constexpr T rounding = 200 * std::numeric_limits<T>::epsilon();
};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(DenseKernels, Precisions);

TYPED_TEST(DenseKernels, TrianglesOfAllSizes) {
  using Matrix = typename TestFixture::Matrix;
  for (const int n : {1, 2, 12, 24, 25, 48, 96, 97}) {
    const int distance = n + 5;
    const Matrix whole = TestFixture::positive(n);
    Matrix stored = Matrix::Constant(distance, n, std::numeric_limits<TypeParam>::quiet_NaN());
    stored.topRows(n).template triangularView<Eigen::Lower>() = whole;
    ASSERT_TRUE(factorize_triangle(n, stored.data(), distance));
    const Matrix lower = stored.topRows(n).template triangularView<Eigen::Lower>();
    EXPECT_LT((lower * lower.transpose() - whole).norm(), TestFixture::rounding * whole.norm()) << n;
    invert_triangle(n, stored.data(), distance);
    const Matrix inverse = stored.topRows(n).template triangularView<Eigen::Lower>();
    EXPECT_LT((inverse * lower - Matrix::Identity(n, n)).norm(), TestFixture::rounding * lower.norm()) << n;
    EXPECT_TRUE(stored.bottomRows(5).array().isNaN().all());
  }
}

TYPED_TEST(DenseKernels, RefuseTrianglesThatAreNotPositiveDefinite) {
  using Matrix = typename TestFixture::Matrix;
  for (const int n : {1, 20, 60}) {
    for (const TypeParam wrong : {TypeParam{-1}, TypeParam{0}, std::numeric_limits<TypeParam>::quiet_NaN(),
                                  std::numeric_limits<TypeParam>::infinity()}) {
      Matrix matrix = Matrix::Identity(n, n);
      matrix(n - 1, n - 1) = wrong;
      EXPECT_FALSE(factorize_triangle(n, matrix.data(), n)) << n << ' ' << wrong;
    }
  }
}

TYPED_TEST(DenseKernels, ProductsAndQuotients) {
  using Matrix = typename TestFixture::Matrix;
  using Vector = typename TestFixture::Vector;
  const Matrix a = TestFixture::values(7, 4, 0.1), b = TestFixture::values(5, 4, 0.2),
               c = TestFixture::values(7, 5, 0.5), l = TestFixture::positive(4).llt().matrixL();
  const auto near = [&](const Matrix& x, const Matrix& y) { return (x - y).norm() < TestFixture::rounding; };
  Matrix result = c;
  subtract_product(7, 5, 4, a.data(), 7, b.data(), 5, result.data(), 7);
  EXPECT_TRUE(near(result, c - a * b.transpose()));
  const Matrix square = TestFixture::positive(7);
  result = square;
  subtract_square(7, 4, a.data(), 7, TypeParam{1}, result.data(), 7);
  EXPECT_TRUE(near(result.template triangularView<Eigen::Lower>(),
                   Matrix(square - a * a.transpose()).template triangularView<Eigen::Lower>()));
  result = a;
  divide_by_triangle(7, 4, l.data(), 4, false, result.data(), 7);
  EXPECT_TRUE(near(result * l.transpose(), a));
  divide_by_triangle(7, 4, l.data(), 4, true, result.data(), 7);
  EXPECT_TRUE(near(result * l * l.transpose(), a));
  const Vector x = TestFixture::values(4, 1, 0.7), y = TestFixture::values(7, 1, 0.8);
  Vector of_x(7), of_y(4);
  times_vector(7, 4, a.data(), 7, false, x.data(), TypeParam{0}, of_x.data());
  times_vector(7, 4, a.data(), 7, true, y.data(), TypeParam{0}, of_y.data());
  EXPECT_TRUE(near(of_x, a * x));
  EXPECT_TRUE(near(of_y, a.transpose() * y));
  times_vector(7, 4, a.data(), 7, true, y.data(), TypeParam{1}, of_y.data());
  EXPECT_TRUE(near(of_y, 2 * a.transpose() * y));
}

}  // namespace
}  // namespace ashlar::dense_kernels_test
