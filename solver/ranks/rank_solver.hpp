// Symmetric positive definite systems of blocks whose rows are shared out among ranks.
//
// Bodies have numbers that all ranks know (global block indices). A rank gives the complete rows of its bodies: their
// diagonal blocks and, for each body beside, the block to the left or right of the diagonal. Functions are collective.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "solver/linear/linear_solver.hpp"
#include "solver/ranks/ranks.hpp"

namespace ashlar {

/// Rows of one body.
struct BodyRows {
  int body = -1;                        ///< global
  std::vector<int> columns;             ///< global bodies, increasing, `body` among them
  std::vector<Eigen::MatrixXd> blocks;  ///< (size of body, size of column), by column
  Eigen::MatrixXd rigid;  ///< (size of body, 6) its rigid motions, the near-null space of multigrid
};

class RankSolver {
 public:
  virtual ~RankSolver() = default;

  /// Prepares solutions. @param rows of the bodies of this rank, by increasing body; may be none
  /// @return the same on all ranks
  [[nodiscard]] virtual FactorStatus factorize(const std::vector<BodyRows>& rows) = 0;
  /// Solves with the last rows, with `refined` to rounding error.
  /// @param right_side of the bodies of this rank, in their order. @return the solution, likewise
  /// @throws std::logic_error unless factorize() succeeded
  [[nodiscard]] virtual Eigen::VectorXd solve(const Eigen::VectorXd& right_side, bool refined = true) = 0;
  /// Cost of factorize() relative to a solution, by the pattern, the same on all ranks; 0: before the first, or it is
  /// not worth keeping.
  [[nodiscard]] virtual double cost_in_solves() const = 0;
  [[nodiscard]] virtual const FactorCounts& counts() const = 0;
};

using RankSolverMaker = std::function<std::unique_ptr<RankSolver>(Ranks& ranks)>;

/// Each rank gathers the whole system and solves it: for tests and few unknowns. Same bits on all ranks.
[[nodiscard]] std::unique_ptr<RankSolver> make_gathered_solver(Ranks& ranks);

}  // namespace ashlar
