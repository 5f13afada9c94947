// Expands a scene to its blocks: arrays, mesh files with many blocks, pieces of masonry, and properties assigned by
// name.
#pragma once

#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Replaces each block with an array, or a mesh that is split, by the blocks it represents, then adds the pieces of
/// masonry, then applies the assignments, unless a masonry has no pieces. Places of a block are those of the
/// [[block]] or [[masonry]] of its origin.
/// @param masonry the blocks of each [[masonry]], in file order
/// @param diagnostics reports more than most_laid_blocks blocks, at the entry with most; copies of an array that need
/// more than most_laid_memory; faults of stones.hpp and assignments.hpp.
void expand_blocks(Scene& scene, std::vector<std::vector<SceneBlock>> masonry, Diagnostics& diagnostics);

}  // namespace ashlar
