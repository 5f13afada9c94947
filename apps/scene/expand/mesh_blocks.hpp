// Mesh files with many blocks, nearly coincident corners, holes or inverted surfaces: mesh = { file, split, group,
// weld, repair, flip }. Changes are made as the scene specifies, and listed in the scene's notes.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// True if the mesh of a block is modified after reading.
[[nodiscard]] bool is_imported(const SceneBlock& block);

/// The blocks represented by a block with such a mesh; any other block itself. First corners are welded (each moves
/// by at most `weld` to an earlier one of the file), then the file is divided, then the parts are repaired, then
/// surfaces are flipped. split = "none": the block itself. "components": NAME.1, NAME.2, ... in the order of their
/// first triangles in the file. "groups": NAME.GROUP for each object or group of an OBJ file that has faces, each
/// physical group of an MSH file. "tetrahedra": NAME.1, NAME.2, ... for each of an MSH file, in its order.
/// Reported at the file's name: a file that cannot be read or has no groups, a weld below the rounding of coordinates
/// or above a tenth of the file's width, a hole that cannot be filled. Whether a part bounds a solid is checked
/// later.
/// @param path of the block as in ScenePlaces
[[nodiscard]] std::vector<SceneBlock> stones_of(Scene& scene, const SceneBlock& block,
                                                const std::string& path, Diagnostics& diagnostics);

}  // namespace ashlar
