// Reads glTF 2.0 (.gltf, .glb): triangles of meshes, placed by the nodes of the scene. Coordinates are those of the
// file, with y upwards.
//
// Materials, normals, skins, morph targets, points and lines are ignored. Rejected with a message: version 1, sparse
// accessors, and required extensions that change shapes (compression, quantized points, instances).
#pragma once

#include <string_view>

#include "apps/scene/meshes/gltf_buffers.hpp"
#include "apps/scene/meshes/shape_layout.hpp"

namespace ashlar {

/// One object for each node with a mesh, with the name of the node or "nodes[INDEX]". Nodes form trees, as the
/// standard requires: a node with two parents, or that is its own ancestor, is refused.
/// @param text of a .gltf file. @throws MeshFileError
[[nodiscard]] ShapeLayout read_gltf(std::string_view text, const BufferFile& file);

/// The same for a .glb file.
[[nodiscard]] ShapeLayout read_glb(std::string_view bytes, const BufferFile& file);

}  // namespace ashlar
