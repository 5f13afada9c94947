// Counts and times of the systems that ranks share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>

#include "solver/ranks/rank_solver.hpp"

namespace ashlar {

/// Work of one rank in shared systems so far.
struct SharedWork {
  std::uint64_t factorizations = 0;  ///< set-ups asked for
  std::uint64_t solves = 0;
  std::uint64_t iterations = 0;    ///< of conjugate gradients
  std::uint64_t own_unknowns = 0;  ///< most of this rank in one system
  double seconds = 0.0;            ///< wall time, waiting for others included
  double processor = 0.0;          ///< s, processor time of this thread

  /// Of two solvers.
  SharedWork& operator+=(const SharedWork& other) {
    factorizations += other.factorizations;
    solves += other.solves;
    iterations += other.iterations;
    own_unknowns = std::max(own_unknowns, other.own_unknowns);
    seconds += other.seconds;
    processor += other.processor;
    return *this;
  }
};

/// Passes everything to another solver.
class MeasuredSolver final : public RankSolver {
 public:
  /// @param solver not null
  explicit MeasuredSolver(std::unique_ptr<RankSolver> solver) : solver_(std::move(solver)) {}

  [[nodiscard]] FactorStatus factorize(const std::vector<BodyRows>& rows) override;
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right_side, bool refined = true) override;
  [[nodiscard]] double cost_in_solves() const override { return solver_->cost_in_solves(); }
  [[nodiscard]] const FactorCounts& counts() const override { return solver_->counts(); }
  [[nodiscard]] SharedWork work() const;

 private:
  std::unique_ptr<RankSolver> solver_;
  SharedWork work_;
};

}  // namespace ashlar
