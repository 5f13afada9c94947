// Reads drawings (DXF as text): 3DFACE, POLYLINE as polyface or polygon mesh, closed outlines with a thickness
// (dxf_outline.hpp), and INSERT of blocks with them. Coordinates are those of the file.
//
// Other entities, and the visibility of edges and layers, are ignored. Rejected with a message: binary DXF, smoothed
// polygon meshes, inserts in rows and columns, and inserts in another plane than xy. Numbers of vertices and faces
// claimed by a drawing are not used, as they may be wrong.
#pragma once

#include <string_view>

#include "apps/scene/meshes/shape_layout.hpp"

namespace ashlar {

/// Largest nesting of blocks.
inline constexpr int most_block_levels = 100;

/// Faces of a layer are one object, in the order of their first faces: those of the drawing itself, then those of its
/// inserts.
/// @throws MeshFileError with line and column
[[nodiscard]] ShapeLayout read_dxf(std::string_view text);

}  // namespace ashlar
