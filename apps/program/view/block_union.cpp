#include "apps/program/view/block_union.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "apps/results/frames/grid_arrays.hpp"

namespace ashlar {
namespace {

/// Cells and points of one block, which follow one another.
struct Range {
  int block;
  std::size_t first_cell, cells;
  int first_point, points;
};

/// In the order of numbers.
std::vector<Range> ranges_of(const UnstructuredGrid& grid) {
  const auto& block = required_values<std::int32_t>(grid.cell_data, "block", 1);
  std::vector<Range> ranges;
  int start = 0, first_point = 0;
  for (std::size_t c = 0; c < grid.offsets.size(); ++c) {
    if (ranges.empty() || ranges.back().block != block[c]) {
      if (!ranges.empty()) first_point = ranges.back().first_point + ranges.back().points;
      ranges.push_back({block[c], c, 0, first_point, 0});
    }
    ++ranges.back().cells;
    for (; start < grid.offsets[c]; ++start) {
      const int point = grid.connectivity[static_cast<std::size_t>(start)] - first_point;
      if (point < 0) throw std::runtime_error("two blocks have a point in common");
      ranges.back().points = std::max(ranges.back().points, point + 1);
    }
  }
  std::stable_sort(ranges.begin(), ranges.end(),
                   [](const Range& x, const Range& y) { return x.block < y.block; });
  const auto same = [](const Range& x, const Range& y) { return x.block == y.block; };
  if (std::adjacent_find(ranges.begin(), ranges.end(), same) != ranges.end())
    throw std::runtime_error("the cells of a block do not follow one another");
  return ranges;
}

DataArray part_of(const DataArray& array, std::size_t first, std::size_t count) {
  DataArray part{array.name, array.components, array.component_names, {}};
  std::visit(
      [&](const auto& values) {
        const auto width = static_cast<std::size_t>(array.components);
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first * width);
        part.values =
            std::decay_t<decltype(values)>(begin, begin + static_cast<std::ptrdiff_t>(count * width));
      },
      array.values);
  return part;
}

UnstructuredGrid part_of(const UnstructuredGrid& grid, const Range& range) {
  UnstructuredGrid part;
  part.points.assign(grid.points.begin() + range.first_point,
                     grid.points.begin() + range.first_point + range.points);
  for (std::size_t c = range.first_cell; c < range.first_cell + range.cells; ++c) {
    std::vector<int> corners;
    for (int k = c == 0 ? 0 : grid.offsets[c - 1]; k < grid.offsets[c]; ++k)
      corners.push_back(grid.connectivity[static_cast<std::size_t>(k)] - range.first_point);
    part.add_cell(grid.types[c], corners);
  }
  for (const DataArray& array : grid.point_data)
    part.point_data.push_back(
        part_of(array, static_cast<std::size_t>(range.first_point), static_cast<std::size_t>(range.points)));
  for (const DataArray& array : grid.cell_data)
    part.cell_data.push_back(part_of(array, range.first_cell, range.cells));
  return part;
}

void append(std::vector<DataArray>& arrays, const std::vector<DataArray>& more) {
  if (arrays.empty()) {
    arrays = more;
    return;
  }
  for (std::size_t k = 0; k < arrays.size(); ++k)
    std::visit(
        [&](auto& values) {
          const auto& added = std::get<std::decay_t<decltype(values)>>(more.at(k).values);
          values.insert(values.end(), added.begin(), added.end());
        },
        arrays[k].values);
}

void append(UnstructuredGrid& grid, const UnstructuredGrid& part) {
  const int first = static_cast<int>(grid.points.size());
  grid.points.insert(grid.points.end(), part.points.begin(), part.points.end());
  int start = 0;
  for (std::size_t c = 0; c < part.offsets.size(); ++c) {
    std::vector<int> corners;
    for (; start < part.offsets[c]; ++start)
      corners.push_back(first + part.connectivity[static_cast<std::size_t>(start)]);
    grid.add_cell(part.types[c], corners);
  }
  append(grid.point_data, part.point_data);
  append(grid.cell_data, part.cell_data);
}

/// The block with nan places.
UnstructuredGrid nowhere(UnstructuredGrid part) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (Vector3& point : part.points) point.setConstant(none);
  for (DataArray& array : part.point_data)
    if (auto* values = std::get_if<std::vector<double>>(&array.values))
      std::fill(values->begin(), values->end(), none);
  return part;
}

}  // namespace

void BlockUnion::add(const UnstructuredGrid& frame) {
  for (const Range& range : ranges_of(frame))
    if (!parts_.contains(range.block)) parts_.emplace(range.block, part_of(frame, range));
}

UnstructuredGrid BlockUnion::whole() const {
  UnstructuredGrid grid;
  for (const auto& [block, part] : parts_) append(grid, part);
  return grid;
}

UnstructuredGrid BlockUnion::completed(UnstructuredGrid frame) const {
  if (parts_.empty()) return frame;
  const std::vector<Range> ranges = ranges_of(frame);
  const auto in_file = [](const Range& x, const Range& y) { return x.first_cell < y.first_cell; };
  if (ranges.size() == parts_.size() && std::is_sorted(ranges.begin(), ranges.end(), in_file)) return frame;
  UnstructuredGrid grid;
  auto there = ranges.begin();
  for (const auto& [block, part] : parts_) {
    if (there != ranges.end() && there->block == block)
      append(grid, part_of(frame, *there++));
    else
      append(grid, nowhere(part));
  }
  return grid;
}

}  // namespace ashlar
