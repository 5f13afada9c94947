// Systems of dense blocks by a factor over subtrees (front_factor.hpp), for islands of many blocks: on several threads,
// and in single precision where that is enough (notes/tree_factor.md).
#pragma once

#include <memory>
#include <vector>

#include "solver/linear/linear_solver.hpp"

namespace ashlar {

/// Precision of a factor's values. Right sides, solutions and residuals are in double precision.
enum class FactorPrecision {
  in_double,  ///< for statics, whose matrices may be nearly singular
  in_single,  ///< with refinement in double; in double precision throughout for a matrix that requires it
};

/// How a factor is computed.
struct FactorUse {
  FactorPrecision precision = FactorPrecision::in_double;
  int threads = 1;  ///< >= 1
};

/// Blocks from which on an island has a tree factor (notes/tree_factor.md).
constexpr int blocks_of_tree_factor = 600;

/// Sets the use of a tree factor from the next factorisation on. No effect on other methods.
void set_use(LinearSolver& solver, const FactorUse& use);

/// States: empty -> analyzed (pattern known) -> factored (values known). Results depend on matrices and right sides only,
/// not on the number of threads, nor on earlier matrices.
class TreeFactor final : public LinearSolver {
 public:
  /// Residual of one solution relative to the right side up to which a factor in single precision is used.
  static constexpr double single_residual = 1e-3;
  /// The same after refinement.
  static constexpr double refined_residual = 1e-12;

  /// @param sizes unknowns of each block, >= 0
  explicit TreeFactor(std::vector<int> sizes, const FactorUse& use = {});
  ~TreeFactor() override;

  void set_use(const FactorUse& use);

  /// Updates the factor to a matrix of dense blocks. Analyses only a new pattern, factorises only new values.
  /// @throws std::invalid_argument if the blocks are not dense. @throws std::bad_alloc
  [[nodiscard]] FactorStatus factorize(const SymmetricMatrix& matrix) override;
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right_side, bool refined = true) override;
  /// Precision of the last factor.
  [[nodiscard]] FactorPrecision precision() const;

  [[nodiscard]] const FactorCounts& counts() const override;
  [[nodiscard]] double cost_in_solves() const override;
  void drop_counts() override;
  [[nodiscard]] const SymmetricMatrix& matrix() const override;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace ashlar
