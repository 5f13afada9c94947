// Reader of glTF 2.0 (.gltf, .glb): triangles of meshes where the nodes of the scene put them. Coordinates are those of the
// file; y is up in them.
//
// Materials, normals, skins, morph targets, points and lines are passed over. Refused by name: version 1, sparse
// accessors, and required extensions that change shapes (compression, quantized points, instances).
#pragma once

#include <string_view>

#include "apps/scene/gltf_buffers.hpp"
#include "apps/scene/shape_layout.hpp"

namespace ashlar {

/// An object for each node with a mesh, under the name of the node, or "nodes[INDEX]". Nodes form trees, as the standard
/// demands: a node with two parents, or that is above itself, is refused.
/// @param text of a .gltf file. @throws MeshFileError
[[nodiscard]] ShapeLayout read_gltf(std::string_view text, const BufferFile& file);

/// The same of a .glb file.
[[nodiscard]] ShapeLayout read_glb(std::string_view bytes, const BufferFile& file);

}  // namespace ashlar
