#include "solver/ranks/measured_solver.hpp"

#include <algorithm>

#include "solver/stopwatch.hpp"
#include "solver/system/processor_watch.hpp"

namespace ashlar {
FactorStatus MeasuredSolver::factorize(const std::vector<BodyRows>& rows) {
  const Stopwatch wall(work_.seconds);
  const ProcessorWatch processor(work_.processor);
  ++work_.factorizations;
  return solver_->factorize(rows);
}

Eigen::VectorXd MeasuredSolver::solve(const Eigen::VectorXd& right_side, bool refined) {
  const Stopwatch wall(work_.seconds);
  const ProcessorWatch processor(work_.processor);
  ++work_.solves;
  work_.own_unknowns = std::max(work_.own_unknowns, static_cast<std::uint64_t>(right_side.size()));
  return solver_->solve(right_side, refined);
}

SharedWork MeasuredSolver::work() const {
  SharedWork work = work_;
  work.iterations = solver_->counts().gradient_iterations;
  return work;
}

}  // namespace ashlar
