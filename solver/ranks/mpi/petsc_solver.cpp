#include "solver/ranks/mpi/petsc_solver.hpp"

#include <Eigen/Cholesky>
#include <limits>
#include <stdexcept>
#include <vector>

#include "solver/ranks/mpi/petsc_method.hpp"

namespace ashlar {
namespace {

class PetscSolver final : public RankSolver {
 public:
  PetscSolver(Ranks& ranks, const PetscSolverLimits& limits) : ranks_(ranks), limits_(limits) {}

  [[nodiscard]] FactorStatus factorize(const std::vector<BodyRows>& rows) override;
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right_side, bool refined) override;
  [[nodiscard]] double cost_in_solves() const override { return method_ ? method_->cost_in_solves() : 0.0; }
  [[nodiscard]] const FactorCounts& counts() const override { return counts_; }

 private:
  [[nodiscard]] bool has_values_of(const std::vector<BodyRows>& rows) const;
  [[nodiscard]] FactorStatus factorize_blocks();
  [[nodiscard]] Eigen::VectorXd solve_blocks(const Eigen::VectorXd& right_side) const;
  [[nodiscard]] Eigen::VectorXd solve_instead(const Eigen::VectorXd& right_side);

  Ranks& ranks_;
  PetscSolverLimits limits_;
  std::unique_ptr<PetscMethod> method_;
  std::unique_ptr<PetscMethod> instead_;  ///< factor of a matrix with which the iteration did not converge
  bool indefinite_ = false;               ///< so is that matrix
  std::vector<BodyRows> rows_;            ///< of the last matrix
  std::vector<Eigen::LLT<Eigen::MatrixXd>> blocks_;  ///< factors of the diagonal blocks, of an iteration
  bool ready_ = false;
  FactorCounts counts_;
};

/// @pre the pattern is that of the last rows
bool PetscSolver::has_values_of(const std::vector<BodyRows>& rows) const {
  bool same = ready_;
  for (std::size_t k = 0; same && k < rows.size(); ++k) same = rows[k].blocks == rows_[k].blocks;
  return !any_rank(ranks_, !same);
}

FactorStatus PetscSolver::factorize_blocks() {
  blocks_.clear();
  bool failed = false;
  for (const BodyRows& row : rows_) {
    for (std::size_t k = 0; k < row.columns.size(); ++k)
      if (row.columns[k] == row.body) failed |= blocks_.emplace_back(row.blocks[k]).info() != Eigen::Success;
  }
  return any_rank(ranks_, failed) ? FactorStatus::not_positive_definite : FactorStatus::success;
}

FactorStatus PetscSolver::factorize(const std::vector<BodyRows>& rows) {
  const bool same_pattern = method_ && method_->has_pattern_of(rows);
  if (same_pattern && has_values_of(rows)) {
    ++counts_.factorizations_reused;
    return FactorStatus::success;
  }
  ready_ = false;
  instead_.reset();
  indefinite_ = false;
  rows_ = rows;
  if (!same_pattern) {
    method_.reset();
    method_ = std::make_unique<PetscMethod>(ranks_, rows_, limits_.most_factored, "");
    ++counts_.analyses;
  }
  if (method_->iterates() && factorize_blocks() != FactorStatus::success)
    return FactorStatus::not_positive_definite;
  const FactorStatus status = method_->set_up(rows_);
  ++counts_.factorizations;
  ready_ = status == FactorStatus::success;
  return status;
}

Eigen::VectorXd PetscSolver::solve_blocks(const Eigen::VectorXd& right_side) const {
  Eigen::VectorXd result(right_side.size());
  Eigen::Index start = 0;
  for (const auto& block : blocks_) {
    result.segment(start, block.rows()) = block.solve(right_side.segment(start, block.rows()));
    start += block.rows();
  }
  return result;
}

/// After an iteration that did not converge, as ConjugateGradients.
Eigen::VectorXd PetscSolver::solve_instead(const Eigen::VectorXd& right_side) {
  if (!instead_ && !indefinite_) {
    instead_ =
        std::make_unique<PetscMethod>(ranks_, rows_, std::numeric_limits<std::int64_t>::max(), "instead_");
    ++counts_.factorizations;
    indefinite_ = instead_->set_up(rows_) != FactorStatus::success;
    if (indefinite_) instead_.reset();
  }
  Eigen::VectorXd solution;
  if (indefinite_ || !instead_->solve(right_side, true, solution)) return solve_blocks(right_side);
  return solution;
}

Eigen::VectorXd PetscSolver::solve(const Eigen::VectorXd& right_side, bool refined) {
  if (!ready_) throw std::logic_error("solve before a successful factorize");
  ++counts_.solves;
  if (instead_ || indefinite_) return solve_instead(right_side);
  Eigen::VectorXd solution;
  const std::uint64_t before = method_->iterations();
  const bool good = method_->solve(right_side, refined, solution);
  counts_.gradient_iterations += method_->iterations() - before;
  if (good || !method_->iterates()) return solution;
  return solve_instead(right_side);
}

}  // namespace

std::unique_ptr<RankSolver> make_petsc_solver(Ranks& ranks, const PetscSolverLimits& limits) {
  return std::make_unique<PetscSolver>(ranks, limits);
}

}  // namespace ashlar
