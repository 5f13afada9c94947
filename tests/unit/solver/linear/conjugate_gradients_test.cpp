#include "solver/linear/conjugate_gradients.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ashlar::conjugate_gradients_test {
namespace {

/// A row of masses between springs of stiffness 1, both ends held: its condition grows with the square of their number.
SymmetricMatrix row_of_springs(int masses) {
  SymmetricMatrix matrix{masses, {0}, {}, {}};
  for (int k = 0; k < masses; ++k) {
    matrix.rows.push_back(k);
    matrix.values.push_back(2.0);
    if (k + 1 < masses) {
      matrix.rows.push_back(k + 1);
      matrix.values.push_back(-1.0);
    }
    matrix.column_start.push_back(static_cast<int>(matrix.rows.size()));
  }
  return matrix;
}

/// The k-th mode of vibration, which gradients find in one step.
Eigen::VectorXd mode(int masses, int k) {
  Eigen::VectorXd shape(masses);
  for (int n = 0; n < masses; ++n) shape[n] = std::sin(std::numbers::pi * k * (n + 1) / (masses + 1));
  return shape;
}

// A solution must not depend on earlier ones: a resumed run does not have them.
TEST(ConjugateGradients, AFactorIsNotKeptForTheNextStep) {
  constexpr int masses = 10'000;
  const SymmetricMatrix matrix = row_of_springs(masses);
  ConjugateGradients fresh(std::vector<int>(masses, 1));
  ASSERT_EQ(fresh.factorize(matrix), FactorStatus::success);
  const Eigen::VectorXd expected = fresh.solve(mode(masses, masses));
  ASSERT_EQ(fresh.counts().factorizations, 0U);

  ConjugateGradients used(std::vector<int>(masses, 1));
  ASSERT_EQ(used.factorize(matrix), FactorStatus::success);
  // A force at an end needs as many iterations as there are masses.
  const Eigen::VectorXd along = used.solve(Eigen::VectorXd::Unit(masses, 0));
  ASSERT_EQ(used.counts().factorizations, 1U) << "it converged";
  EXPECT_NEAR(along[0], masses / (masses + 1.0), 1e-9) << "two springs in parallel, of stiffness 1 and 1/n";
  ASSERT_EQ(used.factorize(matrix), FactorStatus::success);
  EXPECT_TRUE(used.solve(mode(masses, masses)) == expected);
  EXPECT_EQ(used.counts().factorizations, 1U);
}

}  // namespace
}  // namespace ashlar::conjugate_gradients_test
