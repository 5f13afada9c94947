#include "solver/linear/tree_factor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "solver/linear/front_tree.hpp"
#include "solver/linear/sparse_cholesky.hpp"
#include "support/random_blocks.hpp"

namespace ashlar::tree_factor_test {
namespace {

using Pairs = std::vector<std::array<int, 2>>;

Eigen::VectorXd right_side_of(int size) {
  return Eigen::VectorXd::LinSpaced(size, 0.0, 40.0).array().sin() + 0.1;
}

struct Case {
  const char* name;
  std::vector<int> sizes;
  Pairs pairs;
};

std::vector<Case> cases() {
  return {
      {"one block", {12}, {}},
      {"one unknown", {1}, {}},
      {"blocks that touch nothing", {12, 3, 12, 30}, {}},
      {"two islands", {12, 12, 6, 12, 12}, {{0, 3}, {1, 2}, {2, 4}}},
      {"single unknowns", std::vector<int>(300, 1), pairs_of_grid({30, 10, 1})},
      {"a wall", std::vector<int>(54, 12), pairs_of_grid({9, 6, 1})},
      {"order 2", std::vector<int>(18, 30), pairs_of_grid({6, 3, 1})},
      {"order 3 in three dimensions", std::vector<int>(8, 60), pairs_of_grid({2, 2, 2})},
      {"wider than a panel", {250, 12, 130}, {{0, 1}, {1, 2}}},
      {"blocks of several orders", {12, 30, 6, 12, 60, 6, 12, 30, 12}, pairs_of_grid({3, 3, 1})},
      {"a block without motion", {12, 0, 12, 12}, {{0, 2}, {2, 3}}},
  };
}

TEST(TreeFactor, SolvesAsADenseFactorInExtendedPrecision) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    const BlockMatrix blocks = random_blocks(one.sizes, one.pairs, 0.5);
    const SymmetricMatrix& matrix = blocks.matrix();
    const Eigen::VectorXd right_side = right_side_of(matrix.size);
    const Eigen::VectorXd exact = solve_densely(matrix, right_side);
    for (const FactorPrecision precision : {FactorPrecision::in_double, FactorPrecision::in_single}) {
      TreeFactor factor(one.sizes, {precision});
      ASSERT_EQ(factor.factorize(matrix), FactorStatus::success);
      EXPECT_EQ(factor.precision(), precision);
      // The condition number of such matrices is below 1e4; the unit roundoff is 6e-8 in single, 1e-16 in double.
      const double rounding = precision == FactorPrecision::in_single ? 1e-4 : 1e-12;
      EXPECT_LT((factor.solve(right_side, false) - exact).norm(), rounding * exact.norm());
      EXPECT_LT((factor.solve(right_side) - exact).norm(), 1e-11 * exact.norm());
    }
  }
}

TEST(TreeFactor, RefinementGainsInSinglePrecision) {
  const std::vector<int> sizes(100, 12);
  const BlockMatrix blocks = random_blocks(sizes, pairs_of_grid({10, 10, 1}), 1e-2);
  const Eigen::VectorXd right_side = right_side_of(blocks.matrix().size);
  TreeFactor factor(sizes, {FactorPrecision::in_single});
  ASSERT_EQ(factor.factorize(blocks.matrix()), FactorStatus::success);
  ASSERT_EQ(factor.precision(), FactorPrecision::in_single);
  const auto residual = [&](bool refined) {
    return (right_side - times(blocks.matrix(), factor.solve(right_side, refined))).norm() /
           right_side.norm();
  };
  EXPECT_GT(residual(false), 1e-9);  // else it is not single precision
  EXPECT_LT(residual(false), TreeFactor::single_residual);
  EXPECT_LT(residual(true), 10.0 * TreeFactor::refined_residual);
}

/// Wide enough for fronts that several tasks share.
struct Shared {
  std::vector<int> sizes = std::vector<int>(343, 6);
  BlockMatrix blocks = random_blocks(sizes, pairs_of_grid({7, 7, 7}), 0.1);
};

TEST(TreeFactor, HasTheSameBitsOnAnyNumberOfThreads) {
  const Shared shared;
  const SymmetricMatrix& matrix = shared.blocks.matrix();
  const FrontTree tree = make_front_tree(matrix, shared.sizes);
  EXPECT_THAT(tree.parts, testing::Contains(testing::Field(&TreePart::shared, true)));
  const Eigen::VectorXd right_side = right_side_of(matrix.size);
  for (const FactorPrecision precision : {FactorPrecision::in_double, FactorPrecision::in_single}) {
    Eigen::VectorXd first;
    for (const int threads : {1, 2, 3, 8, 2}) {
      TreeFactor factor(shared.sizes, {precision, threads});
      ASSERT_EQ(factor.factorize(matrix), FactorStatus::success);
      const Eigen::VectorXd solution = factor.solve(right_side);
      if (threads == 1) first = solution;
      EXPECT_EQ(solution, first) << threads;
    }
    EXPECT_LT((right_side - times(matrix, first)).norm(), 1e-10 * right_side.norm());
  }
}

TEST(TreeFactor, DependsOnTheLastMatrixOnly) {
  Shared shared;
  const SymmetricMatrix matrix = shared.blocks.matrix();
  const Eigen::VectorXd right_side = right_side_of(matrix.size);
  TreeFactor fresh(shared.sizes, {FactorPrecision::in_single, 2});
  ASSERT_EQ(fresh.factorize(matrix), FactorStatus::success);
  TreeFactor used(shared.sizes, {FactorPrecision::in_double, 3});
  shared.blocks.add_to_diagonal(5, 3.0);
  ASSERT_EQ(used.factorize(shared.blocks.matrix()), FactorStatus::success);
  (void)used.solve(right_side);
  ASSERT_EQ(used.factorize(matrix), FactorStatus::success);
  // The same values in another precision are factorised again.
  set_use(used, {FactorPrecision::in_single, 1});
  ASSERT_EQ(used.factorize(matrix), FactorStatus::success);
  EXPECT_EQ(used.solve(right_side, false), fresh.solve(right_side, false));
  EXPECT_EQ(used.counts().analyses, 1U);
  EXPECT_EQ(used.counts().factorizations, 3U);
  ASSERT_EQ(used.factorize(matrix), FactorStatus::success);
  EXPECT_EQ(used.counts().factorizations_reused, 1U);
  EXPECT_EQ(used.counts().solves, 2U);
}

TEST(TreeFactor, ReportsMatricesThatAreNotPositiveDefinite) {
  Shared shared;
  const SymmetricMatrix sound = shared.blocks.matrix();
  const Eigen::VectorXd right_side = right_side_of(sound.size);
  for (const FactorPrecision precision : {FactorPrecision::in_double, FactorPrecision::in_single}) {
    for (const int threads : {1, 3}) {
      TreeFactor factor(shared.sizes, {precision, threads});
      BlockMatrix blocks = shared.blocks;
      blocks.add_to_diagonal(100, -1e3);  // a negative diagonal
      EXPECT_EQ(factor.factorize(blocks.matrix()), FactorStatus::not_positive_definite);
      EXPECT_THROW((void)factor.solve(right_side), std::logic_error);
      blocks = shared.blocks;
      // Positive diagonals, but x' A x < 0 for x = (1, -1) on the first unknowns of two blocks.
      Eigen::MatrixXd coupling = Eigen::MatrixXd::Zero(6, 6);
      coupling(0, 0) = 1e3;
      blocks.add_pair(0, 1, coupling);
      EXPECT_EQ(factor.factorize(blocks.matrix()), FactorStatus::not_positive_definite);
      ASSERT_EQ(factor.factorize(sound), FactorStatus::success);
      EXPECT_LT((right_side - times(sound, factor.solve(right_side))).norm(), 1e-10 * right_side.norm());
    }
  }
}

/// Springs of stiffness 1 in a row, each mass with very little inertia.
BlockMatrix row_of_springs(int blocks, double inertia, double scale = 1.0) {
  Pairs pairs;
  for (int k = 0; k + 1 < blocks; ++k) pairs.push_back({k, k + 1});
  BlockMatrix matrix(std::vector<int>(static_cast<std::size_t>(blocks), 1), pairs);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Constant(1, 1, scale);
  for (int k = 0; k < blocks; ++k) matrix.add_to_diagonal(k, scale * inertia);
  for (const auto& [a, b] : pairs) {
    matrix.add_diagonal(a, one);
    matrix.add_diagonal(b, one);
    matrix.add_pair(a, b, -one);
  }
  return matrix;
}

TEST(TreeFactor, TakesDoubleWhereSinglePrecisionIsNotEnough) {
  // A rigid motion of 1000 masses: 1e-12 against springs of 1, whose digits in single precision end at 1e-7.
  const BlockMatrix blocks = row_of_springs(1000, 1e-12);
  TreeFactor factor(std::vector<int>(1000, 1), {FactorPrecision::in_single});
  ASSERT_EQ(factor.factorize(blocks.matrix()), FactorStatus::success);
  EXPECT_EQ(factor.precision(), FactorPrecision::in_double);
  // A uniform force f moves all by f / inertia. Rounding of the springs' sum, 1e-16, is 1e-4 of 1e-12.
  const Eigen::VectorXd moved = factor.solve(Eigen::VectorXd::Constant(1000, 1e-12));
  EXPECT_LT((moved.array() - 1.0).abs().maxCoeff(), 1e-2);
}

TEST(TreeFactor, TakesDoubleOutsideTheRangeOfSinglePrecision) {
  const BlockMatrix blocks = row_of_springs(50, 1.0, 1e45);
  TreeFactor factor(std::vector<int>(50, 1), {FactorPrecision::in_single});
  ASSERT_EQ(factor.factorize(blocks.matrix()), FactorStatus::success);
  EXPECT_EQ(factor.precision(), FactorPrecision::in_double);
  // A uniform force stretches no spring.
  const Eigen::VectorXd moved = factor.solve(Eigen::VectorXd::Constant(50, 1e45));
  EXPECT_LT((moved.array() - 1.0).abs().maxCoeff(), 1e-12);
}

TEST(TreeFactor, SolutionsScaleWithTheirRightSides) {
  const BlockMatrix blocks = row_of_springs(50, 1.0);
  TreeFactor factor(std::vector<int>(50, 1), {FactorPrecision::in_single});
  ASSERT_EQ(factor.factorize(blocks.matrix()), FactorStatus::success);
  ASSERT_EQ(factor.precision(), FactorPrecision::in_single);
  const Eigen::VectorXd right_side = right_side_of(50);
  const Eigen::VectorXd solution = factor.solve(right_side);
  // 2^-300 and 2^300 are far outside the range of single precision.
  for (const int exponent : {-300, 300}) {
    const double scale = std::ldexp(1.0, exponent);
    EXPECT_EQ(factor.solve(scale * right_side), scale * solution);
  }
  EXPECT_EQ(factor.solve(Eigen::VectorXd::Zero(50)), Eigen::VectorXd::Zero(50));
}

TEST(TreeFactor, RefusesMatricesOfOtherBlocks) {
  const BlockMatrix blocks = row_of_springs(4, 1.0);
  EXPECT_THROW((void)TreeFactor({1, 1, 1}).factorize(blocks.matrix()), std::invalid_argument);
  EXPECT_THROW((void)TreeFactor({2, 2}).factorize(blocks.matrix()), std::invalid_argument);
  EXPECT_THROW((void)TreeFactor({1}).solve(Eigen::VectorXd::Ones(1)), std::logic_error);
}

TEST(TreeFactor, SolvesNothingForBlocksWithoutUnknowns) {
  TreeFactor factor({0, 0});
  ASSERT_EQ(factor.factorize(BlockMatrix({0, 0}, {}).matrix()), FactorStatus::success);
  EXPECT_EQ(factor.solve(Eigen::VectorXd()).size(), 0);
}

TEST(TreeFactor, IsTheFactorOfManyBlocks) {
  const auto is_tree = [](int blocks) {
    const std::unique_ptr<LinearSolver> solver =
        make_linear_solver(LinearMethod::cholesky, std::vector<int>(static_cast<std::size_t>(blocks), 6));
    return dynamic_cast<TreeFactor*>(solver.get()) != nullptr;
  };
  EXPECT_FALSE(is_tree(blocks_of_tree_factor - 1));
  EXPECT_TRUE(is_tree(blocks_of_tree_factor));
  SparseCholesky other;
  set_use(other, {FactorPrecision::in_single, 4});  // no effect
  const BlockMatrix blocks = row_of_springs(4, 1.0);
  ASSERT_EQ(other.factorize(blocks.matrix()), FactorStatus::success);
  EXPECT_LT((other.solve(Eigen::VectorXd::Ones(4)).array() - 1.0).abs().maxCoeff(), 1e-14);
}

TEST(TreeFactor, KnowsTheCostOfAFactorBeforehand) {
  // One dense front of n: n^3 / 3 multiplications and as many additions against n^2 each of a solution.
  TreeFactor factor({90});
  EXPECT_EQ(factor.cost_in_solves(), 0.0);
  ASSERT_EQ(factor.factorize(random_blocks({90}, {}, 1.0).matrix()), FactorStatus::success);
  EXPECT_NEAR(factor.cost_in_solves(), (90.0 * 91.0 * 181.0 / 6.0) / (2.0 * 90.0 * 91.0), 1e-9);
}

}  // namespace
}  // namespace ashlar::tree_factor_test
