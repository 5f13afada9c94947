// The parts of a straight line inside a closed surface.
//
// A line enters and leaves a solid only where it crosses planes of triangles. Where it does is rounded; whether the
// part between two such places is inside is decided exactly, for its middle (solid_location.hpp), so that a line
// through edges and corners has the right parts all the same. Of two
// solids that share a face, one has the part of a line that lies in it.
#pragma once

#include <array>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// @param solid a closed surface without self-intersections
/// @param start,direction of the line  start + s direction; direction is not zero
/// @param low,high range of s
/// @return [s at its start, s at its end] of each part, increasing, not touching each other
[[nodiscard]] std::vector<std::array<double, 2>> parts_inside(const TriangleMesh& solid, const Vector3& start,
                                                              const Vector3& direction, double low,
                                                              double high);

}  // namespace ashlar
