#include "solver/linear/block_matrix.hpp"

#include <gtest/gtest.h>

#include "solver/linear/conjugate_gradients.hpp"

namespace ashlar::block_matrix_test {
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

class LinearMethods : public testing::TestWithParam<LinearMethod> {};

TEST_P(LinearMethods, SolveAndSkipWhatStands) {
  Example example;
  const auto solver = make_linear_solver(GetParam(), {2, 3, 1});
  const bool gradients = GetParam() == LinearMethod::conjugate_gradients;
  // A factor is refined to rounding.
  const double exact = gradients ? 10.0 * ConjugateGradients::refined_tolerance : 1e-14;
  const Eigen::VectorXd right_side = Eigen::VectorXd::LinSpaced(6, 1, 2);
  EXPECT_THROW((void)solver->solve(right_side), std::logic_error);
  ASSERT_EQ(solver->factorize(example.matrix.matrix()), FactorStatus::success);
  EXPECT_LT((example.expected * solver->solve(right_side) - right_side).norm(), exact);
  EXPECT_LT((example.expected * solver->solve(right_side, false) - right_side).norm(), 1e-5);
  ASSERT_EQ(solver->factorize(example.matrix.matrix()), FactorStatus::success);
  EXPECT_EQ(solver->counts().factorizations_reused, 1U);
  EXPECT_EQ(solver->counts().solves, 2U);
  // Six unknowns: as many iterations at most, but for rounding.
  EXPECT_EQ(solver->counts().gradient_iterations > 0, gradients);
  EXPECT_LE(solver->counts().gradient_iterations, 14U);
  EXPECT_EQ(solver->counts().factorizations, gradients ? 0U : 1U);
  example.matrix.add_to_diagonal(0, 1.0);
  example.expected.topLeftCorner(2, 2).diagonal().array() += 1.0;
  ASSERT_EQ(solver->factorize(example.matrix.matrix()), FactorStatus::success);
  EXPECT_LT((example.expected * solver->solve(right_side) - right_side).norm(), exact);
  EXPECT_EQ(solver->counts().analyses, gradients ? 0U : 1U);
  EXPECT_EQ(solver->counts().factorizations, gradients ? 0U : 2U);
  example.matrix.add_to_diagonal(1, -100.0);
  EXPECT_EQ(solver->factorize(example.matrix.matrix()), FactorStatus::not_positive_definite);
  EXPECT_THROW((void)solver->solve(right_side), std::logic_error);
}

INSTANTIATE_TEST_SUITE_P(All, LinearMethods,
                         testing::Values(LinearMethod::cholesky, LinearMethod::conjugate_gradients));

/// Two bodies of one unknown each: |1, c; c, 1|, positive definite for |c| < 1.
BlockMatrix coupled(double c) {
  BlockMatrix matrix({1, 1}, {{0, 1}});
  matrix.set_zero();
  matrix.add_to_diagonal(0, 1.0);
  matrix.add_to_diagonal(1, 1.0);
  matrix.add_pair(0, 1, Eigen::MatrixXd::Constant(1, 1, c));
  return matrix;
}

TEST(ConjugateGradients, WhatIsNotPositiveDefiniteStillGivesADirectionOfDescent) {
  ConjugateGradients solver({1, 1});
  ASSERT_EQ(solver.factorize(coupled(2.0).matrix()), FactorStatus::success) << "its diagonal blocks are";
  const Eigen::Vector2d right_side(1.0, -1.0);  // its form is -1 along this
  const Eigen::VectorXd solution = solver.solve(right_side);
  EXPECT_GT(solution.dot(right_side), 0.0);
}

// A chain of springs between two walls, pushed at one end: an iteration passes a force on by one body, so that the other
// end is not reached within the iterations that are allowed. x_k = 1 - (k + 1)/(n + 1).
TEST(ConjugateGradients, WhatDoesNotConvergeIsFactorised) {
  constexpr int size = ConjugateGradients::most_iterations + 100;
  const std::vector<int> sizes(size, 1);
  std::vector<std::array<int, 2>> pairs;
  for (int k = 0; k + 1 < size; ++k) pairs.push_back({k, k + 1});
  BlockMatrix matrix(sizes, pairs);
  matrix.set_zero();
  for (int k = 0; k < size; ++k) matrix.add_to_diagonal(k, 2.0);
  for (const auto& [k, l] : pairs) matrix.add_pair(k, l, Eigen::MatrixXd::Constant(1, 1, -1.0));
  ConjugateGradients solver(sizes);
  ASSERT_EQ(solver.factorize(matrix.matrix()), FactorStatus::success);
  const Eigen::VectorXd right_side = Eigen::VectorXd::Unit(size, 0);
  for (int time = 0; time < 2; ++time) {
    const Eigen::VectorXd solution = solver.solve(right_side);
    for (const int k : {0, size / 2, size - 1})
      EXPECT_NEAR(solution[k], 1.0 - (k + 1.0) / (size + 1.0), 1e-9) << k;
  }
  EXPECT_EQ(solver.counts().factorizations, 1U) << "for all solutions with the matrix";
  EXPECT_EQ(solver.counts().gradient_iterations,
            static_cast<std::uint64_t>(ConjugateGradients::most_iterations));
}

}  // namespace
}  // namespace ashlar::block_matrix_test
