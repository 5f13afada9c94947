// Sparse symmetric positive definite systems, by a factor or by conjugate gradients (theory.md section 10).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

namespace ashlar {

/// Lower triangle of a symmetric matrix, compressed columns, rows increasing.
struct SymmetricMatrix {
  int size = 0;
  std::vector<int> column_start;  ///< (size + 1)
  std::vector<int> rows;          ///< (#entries), >= its column
  std::vector<double> values;     ///< (#entries)
};

/// Product with a vector. @param x (size)
[[nodiscard]] Eigen::VectorXd times(const SymmetricMatrix& matrix, const Eigen::VectorXd& x);

/// Outcome of a factorisation.
enum class FactorStatus {
  success,
  not_positive_definite,  ///< a block is free of inertia and stiffness, or the step is far too large
};

/// Number of times each stage ran and was skipped.
struct FactorCounts {
  std::uint64_t analyses = 0;
  std::uint64_t factorizations = 0;
  std::uint64_t factorizations_reused = 0;
  std::uint64_t solves = 0;
  std::uint64_t gradient_iterations = 0;  ///< of conjugate gradients
  FactorCounts& operator+=(const FactorCounts& other) {
    analyses += other.analyses;
    factorizations += other.factorizations;
    factorizations_reused += other.factorizations_reused;
    solves += other.solves;
    gradient_iterations += other.gradient_iterations;
    return *this;
  }
};

/// Methods of solution (notes/conjugate_gradients.md).
enum class LinearMethod {
  cholesky,             ///< sparse_cholesky.hpp
  conjugate_gradients,  ///< conjugate_gradients.hpp
};

/// One system at a time. Results depend on the matrices and right sides only.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// Prepares solutions with a matrix.
  [[nodiscard]] virtual FactorStatus factorize(const SymmetricMatrix& matrix) = 0;
  /// Solves with the last matrix, with `refined` to rounding error.
  /// @param right_side (size). @throws std::logic_error unless factorize() succeeded
  [[nodiscard]] virtual Eigen::VectorXd solve(const Eigen::VectorXd& right_side, bool refined = true) = 0;

  [[nodiscard]] virtual const FactorCounts& counts() const = 0;
  /// Resets the counts.
  virtual void drop_counts() = 0;
  /// Cost of factorize() relative to a solution, by the pattern; 0 before the first.
  [[nodiscard]] virtual double cost_in_solves() const = 0;
  /// The last matrix that was factorised successfully.
  [[nodiscard]] virtual const SymmetricMatrix& matrix() const = 0;
};

/// @param sizes unknowns of each body, in order
[[nodiscard]] std::unique_ptr<LinearSolver> make_linear_solver(LinearMethod method,
                                                               const std::vector<int>& sizes);

}  // namespace ashlar
