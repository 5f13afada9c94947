// Flat polygons of mesh files as triangles.
#pragma once

#include <cstddef>
#include <span>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Appends the #corners - 2 triangles of a polygon, with its orientation and without new points: a fan if it is
/// strictly convex, otherwise ears cut off one after the other. Ears are decided exactly in the projection along
/// the axis nearest to the polygon's normal; corners in straight sides give no triangle without area. A polygon that
/// is not simple gets some triangles, so that the check of the mesh refuses it.
///
/// The triangles are a function of the coordinates in their cyclic order alone: wherever the polygon begins,
/// whichever way round it goes and whatever its corners' indices are, it is divided alike. Two blocks that name
/// the same polygon, which need not be plane, so have the same surface there.
///
/// The time is quadratic in the number of corners, hence a limit.
/// @param corners at least 3 indices into points.
/// @param tests_left of corners in ears, lessened by those made
/// @throws std::length_error if it comes to 0
void triangulate_polygon(const std::vector<Vector3>& points, std::span<const int> corners,
                         std::vector<std::array<int, 3>>& triangles, std::size_t& tests_left);

/// Appends a convex polygon as a fan from the smallest of its indices, wherever its loop begins.
/// @param loop at least 3 indices
void append_fan(std::vector<int> loop, std::vector<std::array<int, 3>>& triangles);

}  // namespace ashlar
