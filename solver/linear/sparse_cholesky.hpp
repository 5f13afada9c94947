// Sparse symmetric positive definite systems by CHOLMOD. The symbolic factorisation is kept while the pattern is
// unchanged, and the numeric one while the values are (theory.md section 10).
#pragma once

#include <memory>

#include "solver/linear/linear_solver.hpp"

namespace ashlar {

/// States: empty -> analyzed (pattern known) -> factored (values known). Movable, not copyable.
class SparseCholesky final : public LinearSolver {
 public:
  SparseCholesky();
  ~SparseCholesky() override;
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// Updates the factor to a matrix. Analyses only a new pattern, factorises only new values.
  /// @throws std::bad_alloc
  [[nodiscard]] FactorStatus factorize(const SymmetricMatrix& matrix) override;

  /// Solves with the last factorised matrix, `refined` with one step of iterative refinement.
  /// @param right_side (size). @throws std::logic_error unless factored
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right_side, bool refined = true) override;

  [[nodiscard]] const FactorCounts& counts() const override;
  [[nodiscard]] double cost_in_solves() const override;
  void drop_counts() override;
  [[nodiscard]] const SymmetricMatrix& matrix() const override;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace ashlar
