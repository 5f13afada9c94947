// Frames with Lagrange triangles (output.curved) as frames with plain ones, for programs that draw these
// only.
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "apps/results/vtu_writer.hpp"

namespace ashlar {

/// How the Lagrange triangles of a run are divided; made from one frame, it serves all, whose cells are the
/// same.
class CurvedCells {
 public:
  /// @param frame with cells in blocks by the cell array "block"; the point array "displacement", if there,
  /// gives the undeformed places, on which the number of pieces depends (pieces_of_sides)
  /// @throws std::runtime_error if a Lagrange triangle has a number of points that no order up to 12 has,
  /// there is no array "block", or one of the two arrays has another type or number of components
  explicit CurvedCells(const UnstructuredGrid& frame);

  /// The frame with small triangles in place of each Lagrange triangle, their points and real point data from
  /// the polynomial of the large one; a frame without any as it is. Points that no cell uses and
  /// whole-numbered point data are left out.
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

  /// Of a triangle of an order whose sides have so many pieces; made when first asked for.
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
