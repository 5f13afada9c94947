#include "solver/linear/block_matrix.hpp"

#include <algorithm>

#include "geometry/index.hpp"

namespace ashlar {

BlockMatrix::BlockMatrix(std::vector<int> sizes, const std::vector<std::array<int, 2>>& pairs)
    : sizes_(std::move(sizes)),
      offsets_(sizes_.size() + 1, 0),
      bodies_below_(sizes_.size()),
      start_below_(sizes_.size()) {
  for (std::size_t i = 0; i < sizes_.size(); ++i) offsets_[i + 1] = offsets_[i] + sizes_[i];
  for (const auto& [i, j] : pairs) bodies_below_[at(i)].push_back(j);
  matrix_.size = offsets_.back();
  matrix_.column_start.push_back(0);
  for (std::size_t i = 0; i < sizes_.size(); ++i) {
    auto& below = bodies_below_[i];
    std::sort(below.begin(), below.end());
    int rows = sizes_[i];
    for (const int j : below) {
      start_below_[i].push_back(rows);
      rows += sizes_[at(j)];
    }
    for (int column = 0; column < sizes_[i]; ++column) {
      for (int row = column; row < sizes_[i]; ++row) matrix_.rows.push_back(offsets_[i] + row);
      for (const int j : below) {
        for (int row = 0; row < sizes_[at(j)]; ++row) matrix_.rows.push_back(offsets_[at(j)] + row);
      }
      matrix_.column_start.push_back(static_cast<int>(matrix_.rows.size()));
    }
  }
  matrix_.values.assign(matrix_.rows.size(), 0.0);
}

std::size_t BlockMatrix::place(int j, int i, int row, int column) const {
  // A column holds the rows of its own block from the diagonal on, followed by the blocks below.
  int start = 0;
  if (j != i) {
    const auto& below = bodies_below_[at(i)];
    start = start_below_[at(i)][static_cast<std::size_t>(std::lower_bound(below.begin(), below.end(), j) -
                                                         below.begin())];
  }
  return at(matrix_.column_start[at(offsets_[at(i)] + column)] + start + row - column);
}

void BlockMatrix::set_zero() {
  std::fill(matrix_.values.begin(), matrix_.values.end(), 0.0);
}

void BlockMatrix::add_diagonal(int body, const Eigen::MatrixXd& block) {
  for (int column = 0; column < sizes_[at(body)]; ++column) {
    double* values = &matrix_.values[place(body, body, column, column)];
    for (int row = column; row < sizes_[at(body)]; ++row) values[row - column] += block(row, column);
  }
}

void BlockMatrix::add_to_diagonal(int body, double value) {
  for (int k = 0; k < sizes_[at(body)]; ++k) matrix_.values[place(body, body, k, k)] += value;
}

void BlockMatrix::add_pair(int i, int j, const Eigen::MatrixXd& block) {
  for (int column = 0; column < sizes_[at(i)]; ++column) {
    double* values = &matrix_.values[place(j, i, 0, column)];
    for (int row = 0; row < sizes_[at(j)]; ++row) values[row] += block(column, row);
  }
}

}  // namespace ashlar
