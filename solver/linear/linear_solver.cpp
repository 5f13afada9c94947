#include "solver/linear/linear_solver.hpp"

#include "solver/linear/conjugate_gradients.hpp"
#include "solver/linear/sparse_cholesky.hpp"
#include "solver/linear/tree_factor.hpp"

namespace ashlar {

Eigen::VectorXd times(const SymmetricMatrix& matrix, const Eigen::VectorXd& x) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(x.size());
  for (int column = 0; column < matrix.size; ++column) {
    const auto first = static_cast<std::size_t>(matrix.column_start[static_cast<std::size_t>(column)]);
    const auto last = static_cast<std::size_t>(matrix.column_start[static_cast<std::size_t>(column) + 1]);
    const double here = x[column];
    double sum = 0.0;  // of the mirrored row of the column
    for (std::size_t k = first; k < last; ++k) {
      const int row = matrix.rows[k];
      y[row] += matrix.values[k] * here;
      sum += row == column ? 0.0 : matrix.values[k] * x[row];
    }
    y[column] += sum;
  }
  return y;
}

std::unique_ptr<LinearSolver> make_linear_solver(LinearMethod method, const std::vector<int>& sizes) {
  if (method == LinearMethod::conjugate_gradients) return std::make_unique<ConjugateGradients>(sizes);
  if (static_cast<int>(sizes.size()) >= blocks_of_tree_factor) return std::make_unique<TreeFactor>(sizes);
  return std::make_unique<SparseCholesky>();
}

}  // namespace ashlar
