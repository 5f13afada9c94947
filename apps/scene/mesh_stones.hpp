// Mesh files of many stones, or with corners that nearly meet, or with holes, or inside out: mesh = { file,
// split, group, weld, repair, flip }. What is done to a file is what the scene asks for, and is told in the scene's notes.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"

namespace ashlar {

/// Whether the mesh of a block is not used as its file has it.
[[nodiscard]] bool is_imported(const SceneBlock& block);

/// The blocks that a block with such a mesh stands for; any other block by itself. First corners are welded
/// (each moves by at most `weld` onto one that comes earlier in the file), then the file is divided, then
/// stones are repaired, then surfaces are turned.
/// split = "none": the block itself. "components": NAME.1, NAME.2, ... in the order in which their first
/// triangles stand in the file. "groups": NAME.GROUP for each object or group of an OBJ file that has faces, each
/// physical group of an MSH file. "tetrahedra": NAME.1, NAME.2, ... for each of an MSH file, in its order.
/// Reported at the file's name: one that cannot be read, one without groups, a weld below the rounding of
/// coordinates or above a tenth of the file's width, a hole that cannot be filled. Whether a stone bounds a solid is found out later.
/// @param path of the block as in ScenePlaces
[[nodiscard]] std::vector<SceneBlock> stones_of(Scene& scene, const SceneBlock& block,
                                                const std::string& path, Diagnostics& diagnostics);

}  // namespace ashlar
