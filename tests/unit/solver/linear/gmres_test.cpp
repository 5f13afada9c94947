#include "solver/linear/gmres.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace ashlar::gmres_test {
namespace {

TEST(Gmres, SolvesAnUnsymmetricSystem) {
  // x = (1, -2, 3): the right side by hand.
  Eigen::Matrix3d a;
  a << 2, 1, 0, -1, 3, 1, 0, -2, 1;
  const Eigen::Vector3d b(0, -4, 7);
  const KrylovSolution solution =
      gmres([&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return a * x; }, b, 1e-13, 3);
  EXPECT_TRUE(solution.converged);
  EXPECT_LT((solution.x - Eigen::Vector3d(1, -2, 3)).norm(), 1e-12);
}

TEST(Gmres, NeedsAsManyIterationsAsTheMatrixIsAwayFromTheIdentity) {
  // The identity and one dyad: two iterations for any size.
  const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(50, 0.0, 1.0);
  const Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(50, 1.0, -0.5);
  const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(50, -3.0, 2.0);
  const auto times = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return x + u * v.dot(x); };
  const KrylovSolution solution = gmres(times, times(expected), 1e-12, 30);
  EXPECT_TRUE(solution.converged);
  EXPECT_EQ(solution.iterations, 2);
  EXPECT_LT((solution.x - expected).norm(), 1e-11 * expected.norm());
}

TEST(Gmres, GivesUpWhereResidualsWouldNotReachTheTolerance) {
  // A cyclic shift of n numbers: from the first unit vector no residual is smaller than the right side before iteration n.
  constexpr int n = 12;
  const auto shift = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd next(n);
    next << x.tail(n - 1), x[0];
    return next;
  };
  const Eigen::VectorXd first = Eigen::VectorXd::Unit(n, 0);
  EXPECT_EQ(gmres(shift, first, 1e-4, 10, KrylovEnd::if_slow).iterations, 3);
  EXPECT_EQ(gmres(shift, first, 1e-4, 10).iterations, 10);
  EXPECT_TRUE(gmres(shift, first, 1e-4, n).converged);
  // Eigenvalues from 1/2 to 1: after k iterations at most 2 (3 - sqrt(8))^k is left, 1e-2 after three, 1e-4 after six.
  const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(n, 0.5, 1.0);
  const auto times = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return values.cwiseProduct(x); };
  const KrylovSolution fast = gmres(times, Eigen::VectorXd::Ones(n), 1e-4, 10, KrylovEnd::if_slow);
  EXPECT_TRUE(fast.converged);
  EXPECT_GT(fast.iterations, 3);
}

TEST(Gmres, TakesAllProductsOfAPassAtOnce) {
  // Hilbert's matrix of size 8: its Krylov vectors are nearly dependent. Two parts of vectors, summed.
  const int n = 8;
  Eigen::MatrixXd a(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) a(i, j) = 1.0 / (1 + i + j);
  a += Eigen::MatrixXd::Identity(n, n) * 1e-6;
  int calls = 0;
  const auto products = [&](const Eigen::Ref<const Eigen::MatrixXd>& columns, const Eigen::VectorXd& x) {
    ++calls;
    return Eigen::VectorXd(columns.topRows(3).transpose() * x.head(3) +
                           columns.bottomRows(n - 3).transpose() * x.tail(n - 3));
  };
  const auto times = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return a * x; };
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, 1.0, -2.0);
  const KrylovSolution solution = gmres(times, b, 1e-10, n, KrylovEnd::after_all, products);
  EXPECT_TRUE(solution.converged);
  EXPECT_EQ(calls, 1 + 2 * solution.iterations);
  EXPECT_LT((times(solution.x) - b).norm(), 1e-9 * b.norm());
}

TEST(Gmres, TellsThatASingularSystemHasNoSolution) {
  const auto times = [](const Eigen::VectorXd& x) -> Eigen::VectorXd { return Eigen::Vector2d(x[0], 0.0); };
  EXPECT_FALSE(gmres(times, Eigen::Vector2d(1, 1), 1e-10, 5).converged);
  const KrylovSolution nothing = gmres(times, Eigen::Vector2d::Zero(), 1e-10, 5);
  EXPECT_TRUE(nothing.converged);
  EXPECT_EQ(nothing.x.norm(), 0.0);
}

}  // namespace
}  // namespace ashlar::gmres_test
