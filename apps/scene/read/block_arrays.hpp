// array = { count, step, stagger }: copies of one [[block]].
#pragma once

#include <cstddef>
#include <vector>

#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Largest number of blocks from arrays and masonry of one scene.
inline constexpr int most_laid_blocks = 20'000;

/// Directions of an array.
inline constexpr std::size_t most_array_directions = 3;

/// Largest memory of copies of blocks, supports and loads of one scene, bytes.
inline constexpr double most_laid_memory = 2e8;

/// Approximate memory of a copy of a block, a support or a load, bytes.
/// @{
[[nodiscard]] double memory_of(const SceneFix& fix);
[[nodiscard]] double memory_of(const SceneLoad& load);
[[nodiscard]] double memory_of(const SceneBlock& block);
/// @}

/// The blocks of an array: NAME.1, NAME.2, ..., the first direction fastest. Block (i, j, k), from 0, is the block
/// translated by i step[0] + j step[1] + k step[2], and by stagger if the last of its indices is odd. Planes and
/// points of its supports and loads are translated too.
[[nodiscard]] std::vector<SceneBlock> blocks_of_array(const SceneBlock& block);

}  // namespace ashlar
