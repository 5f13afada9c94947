// Converts frames with Lagrange triangles (output.curved) to plain triangles, for programs that draw only these.
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "apps/results/frames/vtu/vtu_writer.hpp"

namespace ashlar {

/// Division of the Lagrange triangles of a run; made from one frame, and used for all, whose cells are the same.
class CurvedCells {
 public:
  /// @param frame with cells in blocks by the cell array "block"; the point array "displacement", if present, gives
  /// the undeformed places, which determine the number of segments (pieces_of_sides)
  /// @throws std::runtime_error if the number of points of a Lagrange triangle belongs to no order up to 12, there is
  /// no array "block", or one of the two arrays has another type or number of components
  explicit CurvedCells(const UnstructuredGrid& frame);

  /// The frame with small triangles in place of each Lagrange triangle, with points and real point data from the
  /// polynomial of the large one; a frame without any is unchanged. Unused points and integer point data are omitted.
  /// @throws std::runtime_error if the frame has other cells than the first one
  [[nodiscard]] UnstructuredGrid divided(UnstructuredGrid frame) const;

 private:
  /// A point of the divided frame: the sum of rows_[row][k] times the value at point connectivity_[first +
  /// k].
  struct Point {
    int first;
    int row;
  };
  struct Cell {
    int source;  ///< cell of the frame
    VtkCellType type;
    std::vector<int> points;  ///< indices into points_
  };
  struct Block;
  using RowIndex = std::map<std::array<int, 3>, int>;  ///< row of rows_ by the weights of a lattice point

  /// Rows of a triangle of an order whose sides have so many segments; computed at the first use.
  const RowIndex& rows_for(int order, int pieces);
  void keep(const UnstructuredGrid& frame, int cell, std::vector<int>& new_index);
  void divide(const Block& block, int pieces);
  [[nodiscard]] std::vector<double> interpolated(const std::vector<double>& values,
                                                 std::size_t components) const;

  bool curved_ = false;  ///< false: there is nothing to divide
  std::vector<int> connectivity_;
  std::vector<int> offsets_;
  std::vector<std::vector<double>> rows_ = {{1.0}};
  std::map<std::pair<int, int>, RowIndex> row_of_;  ///< by order and pieces
  std::vector<Point> points_;
  std::vector<Cell> cells_;
};

}  // namespace ashlar
