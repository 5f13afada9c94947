#include "solver/linear/sparse_cholesky.hpp"

#include <cholmod.h>

#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

#include "solver/linear/blas_threads.hpp"
#include "solver/linear/metis_use.hpp"

namespace ashlar {

struct SparseCholesky::Implementation {
  cholmod_common common;
  cholmod_factor* factor = nullptr;
  SymmetricMatrix matrix;
  bool factored = false;
  double cost_in_solves = 0.0;
  FactorCounts counts;

  Implementation() {
    cholmod_start(&common);
    common.print = 0;
    common.final_ll = 1;
    common.supernodal = CHOLMOD_AUTO;
  }
  ~Implementation() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  cholmod_sparse view() {
    cholmod_sparse sparse{};
    sparse.nrow = sparse.ncol = static_cast<std::size_t>(matrix.size);
    sparse.nzmax = matrix.values.size();
    sparse.p = matrix.column_start.data();
    sparse.i = matrix.rows.data();
    sparse.x = matrix.values.data();
    sparse.stype = -1;
    sparse.itype = CHOLMOD_INT;
    sparse.xtype = CHOLMOD_REAL;
    sparse.dtype = CHOLMOD_DOUBLE;
    sparse.sorted = 1;
    sparse.packed = 1;
    return sparse;
  }

  Eigen::VectorXd solve_once(const Eigen::VectorXd& right_side) {
    cholmod_dense dense{};
    dense.nrow = dense.nzmax = dense.d = static_cast<std::size_t>(right_side.size());
    dense.ncol = 1;
    dense.x = const_cast<double*>(right_side.data());
    dense.xtype = CHOLMOD_REAL;
    dense.dtype = CHOLMOD_DOUBLE;
    const auto use = blas_use();
    cholmod_dense* solution = cholmod_solve(CHOLMOD_A, factor, &dense, &common);
    if (solution == nullptr) throw std::bad_alloc();
    const auto freed = [&](cholmod_dense* dense_solution) { cholmod_free_dense(&dense_solution, &common); };
    const std::unique_ptr<cholmod_dense, decltype(freed)> owner(solution, freed);
    return Eigen::Map<const Eigen::VectorXd>(static_cast<double*>(solution->x), right_side.size());
  }

  /// Simplicial factors do not use BLAS.
  [[nodiscard]] std::optional<BlasUse> blas_use() const {
    keep_blas_to_this_thread();
    std::optional<BlasUse> use;
    if (factor->is_super != 0) use.emplace();
    return use;
  }
};

SparseCholesky::SparseCholesky() : implementation_(std::make_unique<Implementation>()) {}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

FactorStatus SparseCholesky::factorize(const SymmetricMatrix& matrix) {
  Implementation& self = *implementation_;
  const bool same_pattern = self.factor != nullptr && matrix.size == self.matrix.size &&
                            matrix.column_start == self.matrix.column_start &&
                            matrix.rows == self.matrix.rows;
  if (same_pattern && self.factored && matrix.values == self.matrix.values) {
    ++self.counts.factorizations_reused;
    return FactorStatus::success;
  }
  self.factored = false;
  self.matrix = matrix;
  // Supports may leave a block of low order no motion.
  self.factored = matrix.size == 0;
  if (self.factored) return FactorStatus::success;
  cholmod_sparse view = self.view();
  if (!same_pattern) {
    keep_blas_to_this_thread();
    cholmod_free_factor(&self.factor, &self.common);
    {
      // METIS is tried where a column of the factor has 500 entries or more on average.
      constexpr int least_for_metis = 500;
      std::optional<MetisUse> alone;
      if (matrix.size >= least_for_metis) alone.emplace();
      self.factor = cholmod_analyze(&view, &self.common);
    }
    if (self.factor == nullptr) throw std::bad_alloc();
    self.cost_in_solves = self.common.fl / (4.0 * self.common.lnz);
    ++self.counts.analyses;
  }
  {
    const auto use = self.blas_use();
    cholmod_factorize(&view, self.factor, &self.common);
  }
  ++self.counts.factorizations;
  if (self.common.status == CHOLMOD_NOT_POSDEF) return FactorStatus::not_positive_definite;
  if (self.common.status < 0) throw std::bad_alloc();
  self.factored = true;
  return FactorStatus::success;
}

Eigen::VectorXd SparseCholesky::solve(const Eigen::VectorXd& right_side, bool refined) {
  Implementation& self = *implementation_;
  if (!self.factored) throw std::logic_error("solve before a successful factorize");
  if (right_side.size() == 0) return right_side;
  ++self.counts.solves;
  Eigen::VectorXd solution = self.solve_once(right_side);
  if (!refined) return solution;
  solution += self.solve_once(right_side - times(self.matrix, solution));
  return solution;
}

const FactorCounts& SparseCholesky::counts() const {
  return implementation_->counts;
}

double SparseCholesky::cost_in_solves() const {
  return implementation_->cost_in_solves;
}

void SparseCholesky::drop_counts() {
  implementation_->counts = {};
}

const SymmetricMatrix& SparseCholesky::matrix() const {
  return implementation_->matrix;
}

}  // namespace ashlar
