#include "solver/linear/conjugate_gradients.hpp"

#include <Eigen/Cholesky>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include "solver/linear/sparse_cholesky.hpp"

namespace ashlar {
namespace {

/// Inverses of the diagonal blocks, with the interface of an Eigen preconditioner.
class BlockJacobi {
 public:
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic };

  void set_sizes(std::vector<int> sizes) {
    sizes_ = std::move(sizes);
    size_ = std::accumulate(sizes_.begin(), sizes_.end(), Eigen::Index{0});
  }
  [[nodiscard]] Eigen::Index rows() const { return size_; }
  [[nodiscard]] Eigen::Index cols() const { return size_; }
  template <class Matrix>
  BlockJacobi& analyzePattern(const Matrix&) {
    return *this;
  }
  template <class Matrix>
  BlockJacobi& factorize(const Matrix& matrix) {
    info_ = Eigen::Success;
    inverses_.clear();
    Eigen::Index start = 0;
    for (const int size : sizes_) {
      // Only the lower triangle of the matrix is stored.
      const Eigen::LLT<Eigen::MatrixXd> factor(Eigen::MatrixXd(matrix.block(start, start, size, size)));
      if (factor.info() != Eigen::Success) info_ = Eigen::NumericalIssue;
      inverses_.emplace_back(factor.solve(Eigen::MatrixXd::Identity(size, size)));
      start += size;
    }
    return *this;
  }
  template <class Matrix>
  BlockJacobi& compute(const Matrix& matrix) {
    return factorize(matrix);
  }
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const {
    Eigen::VectorXd result(right_side.size());
    Eigen::Index start = 0;
    for (const Eigen::MatrixXd& inverse : inverses_) {
      result.segment(start, inverse.rows()) = inverse * right_side.segment(start, inverse.rows());
      start += inverse.rows();
    }
    return result;
  }
  [[nodiscard]] Eigen::ComputationInfo info() const { return info_; }

 private:
  std::vector<int> sizes_;
  Eigen::Index size_ = 0;
  std::vector<Eigen::MatrixXd> inverses_;
  Eigen::ComputationInfo info_ = Eigen::Success;
};

}  // namespace

struct ConjugateGradients::Implementation {
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower, BlockJacobi> gradients;
  SymmetricMatrix matrix;
  Eigen::SparseMatrix<double> sparse;
  bool ready = false;
  FactorCounts counts;
  std::optional<SparseCholesky> instead;  ///< of a matrix for which the iteration did not converge
};

ConjugateGradients::ConjugateGradients(const std::vector<int>& sizes)
    : implementation_(std::make_unique<Implementation>()) {
  implementation_->gradients.preconditioner().set_sizes(sizes);
  implementation_->gradients.setMaxIterations(most_iterations);
}
ConjugateGradients::~ConjugateGradients() = default;

FactorStatus ConjugateGradients::factorize(const SymmetricMatrix& matrix) {
  Implementation& self = *implementation_;
  const bool same_pattern = matrix.size == self.matrix.size &&
                            matrix.column_start == self.matrix.column_start &&
                            matrix.rows == self.matrix.rows;
  // Also for the same matrix: the choice of solver must not depend on earlier systems.
  self.instead.reset();
  if (self.ready && same_pattern && matrix.values == self.matrix.values) {
    ++self.counts.factorizations_reused;
    return FactorStatus::success;
  }
  self.matrix = matrix;
  self.sparse = Eigen::Map<const Eigen::SparseMatrix<double>>(
      matrix.size, matrix.size, static_cast<Eigen::Index>(matrix.values.size()),
      self.matrix.column_start.data(), self.matrix.rows.data(), self.matrix.values.data());
  self.gradients.compute(self.sparse);
  self.ready = self.gradients.preconditioner().info() == Eigen::Success;
  return self.ready ? FactorStatus::success : FactorStatus::not_positive_definite;
}

Eigen::VectorXd ConjugateGradients::solve(const Eigen::VectorXd& right_side, bool refined) {
  Implementation& self = *implementation_;
  if (!self.ready) throw std::logic_error("solve before a successful factorize");
  ++self.counts.solves;
  if (!self.instead) {
    self.gradients.setTolerance(refined ? refined_tolerance : tolerance);
    Eigen::VectorXd solution = self.gradients.solve(right_side);
    self.counts.gradient_iterations += static_cast<std::uint64_t>(self.gradients.iterations());
    // x' A x = x' b is positive for a positive definite matrix.
    if (self.gradients.info() == Eigen::Success && solution.allFinite() && solution.dot(right_side) >= 0.0)
      return solution;
    const FactorStatus status = self.instead.emplace().factorize(self.matrix);
    ++self.counts.factorizations;
    if (status != FactorStatus::success) {
      self.instead.reset();
      return self.gradients.preconditioner().solve(right_side);
    }
  }
  return self.instead->solve(right_side, refined);
}

const FactorCounts& ConjugateGradients::counts() const {
  return implementation_->counts;
}

void ConjugateGradients::drop_counts() {
  implementation_->counts = {};
}

const SymmetricMatrix& ConjugateGradients::matrix() const {
  return implementation_->matrix;
}

}  // namespace ashlar
