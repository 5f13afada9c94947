#include "apps/program/view/curved_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "apps/results/frames/drawn_surface.hpp"
#include "apps/results/frames/grid_arrays.hpp"
#include "apps/results/frames/lagrange_triangle.hpp"
#include "geometry/index.hpp"
#include "mechanics/basis/basis.hpp"

namespace ashlar {
namespace {

/// The order n with (n + 1)(n + 2) / 2 points.
int order_of(int points) {
  int order = 1;
  while (order < PolynomialBasis::max_order && (order + 1) * (order + 2) / 2 < points) ++order;
  if ((order + 1) * (order + 2) / 2 != points)
    throw std::runtime_error(fmt::format("a Lagrange triangle with {} points", points));
  return order;
}

std::vector<Vector3> undeformed(const UnstructuredGrid& frame) {
  std::vector<Vector3> points = frame.points;
  const auto* values = find_values<double>(frame.point_data, "displacement", 3);
  if (values == nullptr) return points;
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] -= Vector3((*values)[3 * i], (*values)[3 * i + 1], (*values)[3 * i + 2]);
  return points;
}

/// Triangles with their corners as the only points, renumbered.
CurvedTriangles with_own_points(const CurvedTriangles& triangles, const std::vector<Vector3>& points) {
  CurvedTriangles own{triangles.order, {}, triangles.corners};
  std::unordered_map<int, int> number;
  for (auto& corners : own.corners) {
    for (int& corner : corners) {
      const auto [known, is_new] = number.try_emplace(corner, static_cast<int>(own.points.size()));
      if (is_new) own.points.push_back(points[at(corner)]);
      corner = known->second;
    }
  }
  return own;
}

/// The values of some cells, consecutively.
template <class T>
std::vector<T> chosen(const std::vector<T>& values, const std::vector<int>& cells, int components) {
  std::vector<T> result;
  for (const int cell : cells)
    for (int c = 0; c < components; ++c) result.push_back(values[at(cell * components + c)]);
  return result;
}

}  // namespace

/// The Lagrange triangles of one block and one order.
struct CurvedCells::Block {
  CurvedTriangles triangles;
  std::vector<int> cells;  ///< (#triangles) of the frame
};

CurvedCells::CurvedCells(const UnstructuredGrid& frame)
    : connectivity_(frame.connectivity), offsets_(frame.offsets) {
  const auto is_curved = [](VtkCellType type) { return type == VtkCellType::lagrange_triangle; };
  curved_ = std::any_of(frame.types.begin(), frame.types.end(), is_curved);
  if (!curved_) return;
  const auto& block_of_cell = required_values<std::int32_t>(frame.cell_data, "block", 1);
  std::map<std::pair<int, int>, Block> blocks;  // by number and order
  std::vector<int> new_index(frame.points.size(), -1);
  for (int cell = 0; cell < static_cast<int>(frame.types.size()); ++cell) {
    if (!is_curved(frame.types[at(cell)])) {
      keep(frame, cell, new_index);
      continue;
    }
    const int first = cell == 0 ? 0 : offsets_[at(cell) - 1];
    const int order = order_of(offsets_[at(cell)] - first);
    Block& block = blocks[{block_of_cell[at(cell)], order}];
    block.triangles.order = order;
    block.triangles.corners.push_back(
        {connectivity_[at(first)], connectivity_[at(first) + 1], connectivity_[at(first) + 2]});
    block.cells.push_back(cell);
  }
  const std::vector<Vector3> points = undeformed(frame);
  std::vector<CurvedTriangles> triangles;
  triangles.reserve(blocks.size());
  for (const auto& [key, block] : blocks) triangles.push_back(with_own_points(block.triangles, points));
  const std::vector<int> pieces = pieces_of_sides(triangles);
  std::size_t next = 0;
  for (const auto& [key, block] : blocks) divide(block, pieces[next++]);
}

void CurvedCells::keep(const UnstructuredGrid& frame, int cell, std::vector<int>& new_index) {
  Cell kept{cell, frame.types[at(cell)], {}};
  for (int k = cell == 0 ? 0 : offsets_[at(cell) - 1]; k < offsets_[at(cell)]; ++k) {
    int& index = new_index[at(connectivity_[at(k)])];
    if (index < 0) {
      index = static_cast<int>(points_.size());
      points_.push_back({k, 0});
    }
    kept.points.push_back(index);
  }
  cells_.push_back(std::move(kept));
}

const CurvedCells::RowIndex& CurvedCells::rows_for(int order, int pieces) {
  const auto [known, is_new] = row_of_.try_emplace({order, pieces});
  if (!is_new) return known->second;
  for (const LatticeWeights& weights : lagrange_nodes(pieces)) {
    known->second.emplace(weights, static_cast<int>(rows_.size()));
    rows_.push_back(lagrange_values(
        order, {static_cast<double>(weights[0]) / pieces, static_cast<double>(weights[1]) / pieces,
                static_cast<double>(weights[2]) / pieces}));
  }
  return known->second;
}

void CurvedCells::divide(const Block& block, int pieces) {
  const RowIndex& row_of = rows_for(block.triangles.order, pieces);
  const SharedLattice lattice = shared_lattice(block.triangles.corners, pieces);
  const int first_point = static_cast<int>(points_.size());
  for (const SharedLattice::Point& point : lattice.points) {
    const int cell = block.cells[point.cell];
    points_.push_back({cell == 0 ? 0 : offsets_[at(cell) - 1], row_of.at(point.weights)});
  }
  const auto small = lattice_triangles(pieces);
  for (std::size_t t = 0; t < block.cells.size(); ++t) {
    const std::vector<int>& nodes = lattice.nodes[t];
    for (const auto& [a, b, c] : small)
      cells_.push_back(
          {block.cells[t],
           VtkCellType::triangle,
           {first_point + nodes[at(a)], first_point + nodes[at(b)], first_point + nodes[at(c)]}});
  }
}

std::vector<double> CurvedCells::interpolated(const std::vector<double>& values,
                                              std::size_t components) const {
  std::vector<double> result;
  result.reserve(points_.size() * components);
  for (const Point& point : points_) {
    const std::vector<double>& row = rows_[at(point.row)];
    for (std::size_t c = 0; c < components; ++c) {
      double sum = 0.0;
      for (std::size_t k = 0; k < row.size(); ++k)
        sum += row[k] * values[components * at(connectivity_[at(point.first) + k]) + c];
      result.push_back(sum);
    }
  }
  return result;
}

UnstructuredGrid CurvedCells::divided(UnstructuredGrid frame) const {
  if (frame.connectivity != connectivity_ || frame.offsets != offsets_)
    throw std::runtime_error("the frames have different cells");
  if (!curved_) return frame;
  UnstructuredGrid grid;
  std::vector<double> places;
  for (const Vector3& point : frame.points)
    for (int k = 0; k < 3; ++k) places.push_back(point[k]);
  places = interpolated(places, 3);
  for (std::size_t i = 0; i < points_.size(); ++i)
    grid.points.emplace_back(places[3 * i], places[3 * i + 1], places[3 * i + 2]);
  for (const Cell& cell : cells_) grid.add_cell(cell.type, cell.points);
  for (DataArray& array : frame.point_data) {
    const auto* reals = std::get_if<std::vector<double>>(&array.values);
    if (reals == nullptr) continue;
    auto values = interpolated(*reals, at(array.components));
    array.values = std::move(values);
    grid.point_data.push_back(std::move(array));
  }
  std::vector<int> sources;
  for (const Cell& cell : cells_) sources.push_back(cell.source);
  for (DataArray& array : frame.cell_data) {
    if (auto* reals = std::get_if<std::vector<double>>(&array.values)) {
      array.values = chosen(*reals, sources, array.components);
    } else {
      array.values = chosen(std::get<std::vector<std::int32_t>>(array.values), sources, array.components);
    }
    grid.cell_data.push_back(std::move(array));
  }
  return grid;
}

}  // namespace ashlar
