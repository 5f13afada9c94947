// From what a scene says to its blocks: arrays are laid out, mesh files of many stones are divided, pieces of
// masonry are added, and properties are assigned by name.
#pragma once

#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"

namespace ashlar {

/// Puts in place of each block with an array, or a mesh that is split, the blocks that it stands for, then
/// adds the pieces of masonry, then applies the assignments, unless a masonry has no pieces. Places of a block are those of the [[block]] or
/// [[masonry]] that it comes from.
/// @param masonry the blocks of each [[masonry]], in file order
/// Reported: more than most_laid_blocks blocks, at the entry that has most; copies of an array that take more
/// than most_laid_memory; what stones.hpp and
/// assignments.hpp report.
void expand_blocks(Scene& scene, std::vector<std::vector<SceneBlock>> masonry, Diagnostics& diagnostics);

}  // namespace ashlar
