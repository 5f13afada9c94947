// Conjugate gradients with the diagonal blocks of the bodies as preconditioner (Eigen). Without a factor, memory is
// that of the matrix, and time grows little faster. For many blocks stacked in three dimensions.
#pragma once

#include <memory>
#include <vector>

#include "solver/linear/linear_solver.hpp"

namespace ashlar {

/// If a system does not converge within `most_iterations`, it and all later ones are solved by a factor until the
/// next factorize().
class ConjugateGradients final : public LinearSolver {
 public:
  static constexpr int most_iterations = 3000;
  /// Residual relative to the right side, of refined solutions and of others.
  static constexpr double refined_tolerance = 1e-12;
  static constexpr double tolerance = 1e-6;

  /// @param sizes unknowns of each body, in order
  explicit ConjugateGradients(const std::vector<int>& sizes);
  ~ConjugateGradients() override;
  ConjugateGradients(const ConjugateGradients&) = delete;
  ConjugateGradients& operator=(const ConjugateGradients&) = delete;

  /// @return not_positive_definite if a diagonal block is not. If the matrix is found indefinite in solve() only,
  /// that solve() returns the solution with the diagonal blocks alone, which is a descent direction
  [[nodiscard]] FactorStatus factorize(const SymmetricMatrix& matrix) override;
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right_side, bool refined = true) override;
  [[nodiscard]] const FactorCounts& counts() const override;
  void drop_counts() override;
  [[nodiscard]] double cost_in_solves() const override { return 0.0; }
  [[nodiscard]] const SymmetricMatrix& matrix() const override;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace ashlar
