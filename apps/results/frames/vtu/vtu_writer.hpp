// Frames for ParaView: an unstructured grid with data on its points and cells as a VTK XML file (.vtu),
// little-endian, zlib-compressed, with binary data appended raw as by ParaView itself. The order of bytes suits
// meshio too (which rejects the names of blocks).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "apps/results/frames/stored_real.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Cells with VTK's numbers.
enum class VtkCellType : std::uint8_t {
  vertex = 1,                 ///< one point
  line = 3,                   ///< two points
  triangle = 5,               ///< three points
  polygon = 7,                ///< three or more points, planar, in order around the boundary
  tetrahedron = 10,           ///< four points; the last sees the others counter-clockwise from within
  lagrange_triangle = 69,     ///< (n + 1)(n + 2) / 2 points of order n, see lagrange_triangle.hpp
  lagrange_tetrahedron = 71,  ///< (n + 1)(n + 2)(n + 3) / 6 points, see lagrange_tetrahedron.hpp
};

/// Largest number of components of a field: a tensor has nine.
inline constexpr int most_components = 9;

/// One field. ParaView shows 3 components as a vector and 9 (row by row) as a tensor; it reads 6 as a symmetric
/// tensor in the order xx, yy, zz, xy, yz, xz.
struct DataArray {
  std::string name;
  int components = 1;                        ///< values of each point or cell, 1 to most_components
  std::vector<std::string> component_names;  ///< none, or one for each component
  std::variant<std::vector<double>, std::vector<std::int32_t>>
      values;                               ///< (#points or #cells x components), point after point
  StoredReal stored = StoredReal::float64;  ///< of doubles
};

/// Content of one file. Empty grids are valid: a frame without contacts has no points.
struct UnstructuredGrid {
  std::vector<Vector3> points;  ///< (#points), m
  StoredReal stored_points = StoredReal::float64;
  std::vector<int> connectivity;   ///< point indices, cell after cell
  std::vector<int> offsets;        ///< (#cells), end of each cell in `connectivity`
  std::vector<VtkCellType> types;  ///< (#cells)
  std::vector<DataArray> point_data;
  std::vector<DataArray> cell_data;
  std::optional<double> time;            ///< s, VTK's TimeValue
  std::vector<std::string> block_names;  ///< UTF-8, by the numbers of a field `block`; empty: not written

  void add_cell(VtkCellType type, std::span<const int> cell_points);
};

/// @throws std::invalid_argument if a size, an offset or an index is invalid, or two arrays of the points (or of the
/// cells) share a name.
void validate(const UnstructuredGrid& grid);

/// @return the bytes of the .vtu file. @throws as validate.
[[nodiscard]] std::string to_vtu(const UnstructuredGrid& grid);

/// Writes to_vtu(grid) atomically. @throws as to_vtu, or std::runtime_error with path and reason.
void write_vtu(const std::filesystem::path& path, const UnstructuredGrid& grid);

}  // namespace ashlar
