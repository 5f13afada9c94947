#include "solver/linear/block_matrix.hpp"

#include <gtest/gtest.h>

namespace ashlar {
namespace {

Eigen::MatrixXd dense(const SymmetricMatrix& matrix) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(matrix.size, matrix.size);
  for (int column = 0; column < matrix.size; ++column) {
    const auto first = static_cast<std::size_t>(matrix.column_start[static_cast<std::size_t>(column)]);
    const auto last = static_cast<std::size_t>(matrix.column_start[static_cast<std::size_t>(column) + 1]);
    for (std::size_t k = first; k < last; ++k) {
      result(matrix.rows[k], column) = result(column, matrix.rows[k]) = matrix.values[k];
    }
  }
  return result;
}

/// Bodies of 2, 3 and 1 unknowns; the first touches both others.
struct Example {
  BlockMatrix matrix{{2, 3, 1}, {{0, 2}, {0, 1}}};
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(6, 6);
  Example() {
    Eigen::MatrixXd a(2, 2);
    a << 4, 1, 1, 5;
    Eigen::MatrixXd b(3, 3);
    b << 6, 0.5, 0, 0.5, 7, 0.25, 0, 0.25, 8;
    Eigen::MatrixXd ab(2, 3);
    ab << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6;
    Eigen::MatrixXd ac(2, 1);
    ac << 0.7, 0.8;
    matrix.set_zero();
    matrix.add_diagonal(0, a);
    matrix.add_diagonal(1, b);
    matrix.add_to_diagonal(2, 9.0);
    matrix.add_pair(0, 1, ab);
    matrix.add_pair(0, 2, ac);
    expected.block(0, 0, 2, 2) = a;
    expected.block(2, 2, 3, 3) = b;
    expected(5, 5) = 9.0;
    expected.block(0, 2, 2, 3) = ab;
    expected.block(2, 0, 3, 2) = ab.transpose();
    expected.block(0, 5, 2, 1) = ac;
    expected.block(5, 0, 1, 2) = ac.transpose();
  }
};

TEST(BlockMatrix, PlacesEveryBlock) {
  const Example example;
  EXPECT_EQ(dense(example.matrix.matrix()), example.expected);
  EXPECT_EQ(example.matrix.offset(2), 5);
}

TEST(SparseCholesky, SolvesAndSkipsWhatStands) {
  Example example;
  SparseCholesky factor;
  ASSERT_EQ(factor.factorize(example.matrix.matrix()), FactorStatus::success);
  const Eigen::VectorXd right_side = Eigen::VectorXd::LinSpaced(6, 1, 2);
  EXPECT_LT((example.expected * factor.solve(right_side) - right_side).norm(), 1e-14);
  ASSERT_EQ(factor.factorize(example.matrix.matrix()), FactorStatus::success);
  EXPECT_EQ(factor.counts().factorizations, 1U);
  EXPECT_EQ(factor.counts().factorizations_reused, 1U);
  example.matrix.add_to_diagonal(0, 1.0);
  ASSERT_EQ(factor.factorize(example.matrix.matrix()), FactorStatus::success);
  EXPECT_EQ(factor.counts().analyses, 1U);
  EXPECT_EQ(factor.counts().factorizations, 2U);
  example.matrix.add_to_diagonal(1, -100.0);
  EXPECT_EQ(factor.factorize(example.matrix.matrix()), FactorStatus::not_positive_definite);
  EXPECT_THROW((void)factor.solve(right_side), std::logic_error);
}

}  // namespace
}  // namespace ashlar
