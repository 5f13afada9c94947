// Random matrices of blocks, and dense solutions to compare with.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>
#include <random>
#include <vector>

#include "solver/linear/block_matrix.hpp"

namespace ashlar {

/// Blocks of a grid, each joined to its neighbours along the axes.
[[nodiscard]] inline std::vector<std::array<int, 2>> pairs_of_grid(const std::array<int, 3>& counts) {
  const auto number = [&](int i, int j, int k) { return (k * counts[1] + j) * counts[0] + i; };
  std::vector<std::array<int, 2>> pairs;
  for (int k = 0; k < counts[2]; ++k) {
    for (int j = 0; j < counts[1]; ++j) {
      for (int i = 0; i < counts[0]; ++i) {
        if (i + 1 < counts[0]) pairs.push_back({number(i, j, k), number(i + 1, j, k)});
        if (j + 1 < counts[1]) pairs.push_back({number(i, j, k), number(i, j + 1, k)});
        if (k + 1 < counts[2]) pairs.push_back({number(i, j, k), number(i, j, k + 1)});
      }
    }
  }
  return pairs;
}

/// As of contacts: each pair adds the square of three random rows over the unknowns of both blocks.
/// @param inertia on the diagonal
[[nodiscard]] inline BlockMatrix random_blocks(const std::vector<int>& sizes,
                                               const std::vector<std::array<int, 2>>& pairs, double inertia,
                                               unsigned seed = 7) {
  std::mt19937 random(seed);
  BlockMatrix matrix(sizes, pairs);
  for (std::size_t k = 0; k < sizes.size(); ++k) matrix.add_to_diagonal(static_cast<int>(k), inertia);
  for (const auto& [a, b] : pairs) {
    const int of_a = sizes[static_cast<std::size_t>(a)], of_b = sizes[static_cast<std::size_t>(b)];
    Eigen::MatrixXd rows(3, of_a + of_b);
    // Not std::normal_distribution, which depends on the library.
    for (double& value : rows.reshaped()) value = static_cast<double>(random()) / 2147483648.0 - 1.0;
    const Eigen::MatrixXd square = rows.transpose() * rows;
    matrix.add_diagonal(a, square.topLeftCorner(of_a, of_a));
    matrix.add_diagonal(b, square.bottomRightCorner(of_b, of_b));
    matrix.add_pair(a, b, square.topRightCorner(of_a, of_b));
  }
  return matrix;
}

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// The whole matrix, in extended precision.
[[nodiscard]] inline LongMatrix long_dense(const SymmetricMatrix& matrix) {
  LongMatrix result = LongMatrix::Zero(matrix.size, matrix.size);
  for (int column = 0; column < matrix.size; ++column) {
    const auto first = static_cast<std::size_t>(matrix.column_start[static_cast<std::size_t>(column)]);
    const auto last = static_cast<std::size_t>(matrix.column_start[static_cast<std::size_t>(column) + 1]);
    for (std::size_t k = first; k < last; ++k)
      result(matrix.rows[k], column) = result(column, matrix.rows[k]) = matrix.values[k];
  }
  return result;
}

/// Solution by a dense Cholesky factor in extended precision, rounded.
[[nodiscard]] inline Eigen::VectorXd solve_densely(const SymmetricMatrix& matrix,
                                                   const Eigen::VectorXd& right_side) {
  return long_dense(matrix).llt().solve(right_side.cast<long double>()).cast<double>();
}

}  // namespace ashlar
