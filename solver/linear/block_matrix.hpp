// A symmetric matrix of dense blocks, one row of blocks for each body of an island, in CHOLMOD's storage format.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/linear/linear_solver.hpp"

namespace ashlar {

/// The pattern is constant after construction: all diagonal blocks and one block for each pair.
class BlockMatrix {
 public:
  /// @param sizes unknowns of each body, > 0. @param pairs (i < j), each once
  BlockMatrix(std::vector<int> sizes, const std::vector<std::array<int, 2>>& pairs);

  [[nodiscard]] const SymmetricMatrix& matrix() const { return matrix_; }
  /// First unknown of a body.
  [[nodiscard]] int offset(int body) const { return offsets_[static_cast<std::size_t>(body)]; }
  void set_zero();
  /// Adds the lower triangle of a symmetric block. @param block (size, size)
  void add_diagonal(int body, const Eigen::MatrixXd& block);
  void add_to_diagonal(int body, double value);
  /// Adds a block and, by symmetry, its transpose. @param i < j; @param block (size of i, size of j)
  void add_pair(int i, int j, const Eigen::MatrixXd& block);

 private:
  /// Place of the entry (row, column) of the block (j, i), j >= i, of the lower triangle.
  [[nodiscard]] std::size_t place(int j, int i, int row, int column) const;

  std::vector<int> sizes_;
  std::vector<int> offsets_;
  std::vector<std::vector<int>> bodies_below_;  ///< for each body i: bodies j > i paired with it, increasing
  std::vector<std::vector<int>>
      start_below_;  ///< first row of block (j, i) below the diagonal block's columns
  SymmetricMatrix matrix_;
};

}  // namespace ashlar
