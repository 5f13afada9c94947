// Terrain on a grid: ESRI ASCII grids (.asc) and lists of points (.xyz), as surfaces of two triangles a cell, open at
// their rim (open_terrain.hpp closes them).
//
//   ncols 3               x, y, z in each line of an .xyz file, in any order of the points; columns are separated by
//   nrows 2               blanks, commas, semicolons or tabs, and a first line without numbers is passed over. The
//   xllcorner 100         points must lie on a grid of the x and the y that occur; points may be missing.
//   yllcorner 200
//   cellsize 10           Lines of heights from north to south. Heights are those of the middles of cells; xllcenter
//   NODATA_value -9999    and yllcenter may be given instead.
//   1 2 3
//   4 5 6
//
// A cell of four points is divided from its south-western to its north-eastern corner. Cells without one of their
// points are left out.
#pragma once

#include <filesystem>
#include <istream>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// True for .asc and .xyz.
[[nodiscard]] bool is_height_grid(const std::filesystem::path& path);

/// @param path .asc or .xyz. @throws MeshFileError with line and column
[[nodiscard]] TriangleMesh read_height_grid(const std::filesystem::path& path);

/// The same for the content of a file. @throws MeshFileError: a missing key, fewer or more heights than ncols times
/// nrows, a field that is not a number, two points of one x and y, no whole cell, more than most_grid_points
[[nodiscard]] TriangleMesh parse_esri_grid(std::istream& content);
[[nodiscard]] TriangleMesh parse_xyz_grid(std::istream& content);

/// Of the grid, missing ones included.
inline constexpr double most_grid_points = 4e6;

}  // namespace ashlar
