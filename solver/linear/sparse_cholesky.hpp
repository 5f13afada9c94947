// Sparse symmetric positive definite systems by CHOLMOD, with the symbolic factorisation kept while the
// pattern stands and the numeric one while the values stand (theory.md section 10).
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
  out_of_memory,
};

/// How often each stage ran and was skipped.
struct FactorCounts {
  std::uint64_t analyses = 0;
  std::uint64_t factorizations = 0;
  std::uint64_t factorizations_reused = 0;
  std::uint64_t solves = 0;
  FactorCounts& operator+=(const FactorCounts& other) {
    analyses += other.analyses;
    factorizations += other.factorizations;
    factorizations_reused += other.factorizations_reused;
    solves += other.solves;
    return *this;
  }
};

/// States: empty -> analyzed (pattern known) -> factored (values known). Movable, not copyable.
class SparseCholesky {
 public:
  SparseCholesky();
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// Brings the factor to a matrix; analyses only if the pattern changed, factorises only if the values
  /// changed.
  [[nodiscard]] FactorStatus factorize(const SymmetricMatrix& matrix);

  /// Solves with the last factorised matrix, `refined` with one step of iterative refinement.
  /// @param right_side (size). @throws std::logic_error unless factored
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right_side, bool refined = true);

  [[nodiscard]] const FactorCounts& counts() const;
  /// Operations of a factorisation in those of a solution, by the pattern; 0 before the first.
  [[nodiscard]] double cost_in_solves() const;
  /// Starts to count at zero.
  void drop_counts();
  /// The matrix that was factorised last.
  [[nodiscard]] const SymmetricMatrix& matrix() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace ashlar
