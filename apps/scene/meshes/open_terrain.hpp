// From an open surface, as a survey gives it, to a body: walls down from its rim and a plane bottom.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Closes a surface by upright walls below its rim and by its vertical projection to z = bottom, so that every face of
/// the bottom lies in one plane. The surface may have holes, which become shafts with walls of their own; its triangles
/// are turned upward first, all together.
/// @throws std::invalid_argument if the surface has no rim, if a triangle is upright or overhangs (its projection is not
/// counter-clockwise), if an edge has more than two triangles, or if a corner is not above the bottom
void close_terrain_below(TriangleMesh& mesh, double bottom);

}  // namespace ashlar
