// Parts of blocks that have cracked, and the blocks of the scene that they come from.
#pragma once

#include <vector>

#include "apps/scene/model/scene.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// By block of a simulation: number of the block of the scene of which it is a part. The first part has that number itself;
/// the others follow all blocks of the scene and are named after it (solver/fracture/divided_block.hpp).
/// @throws std::logic_error if a block is no part of any
[[nodiscard]] std::vector<int> original_blocks(const Scene& scene, const std::vector<BlockModel>& blocks);

/// The part at a point of the placed, undeformed block, or nearest to it. @param original number of the block of the scene
/// @param parts of original_blocks(). @param point m
[[nodiscard]] int part_at(const std::vector<BlockModel>& blocks, const std::vector<int>& parts, int original,
                          const Vector3& point);

}  // namespace ashlar
