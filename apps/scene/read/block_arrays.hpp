// array = { count, step, stagger }: copies of one [[block]].
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/model/scene.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// Largest number of blocks from arrays and masonry of one scene.
inline constexpr int most_laid_blocks = 20'000;

/// Largest memory of copies of blocks, supports and loads of one scene, bytes.
inline constexpr double most_laid_memory = 2e8;

/// Approximate memory of a copy of a block, a support or a load, bytes.
/// @{
[[nodiscard]] double memory_of(const SceneFix& fix);
[[nodiscard]] double memory_of(const SceneLoad& load);
[[nodiscard]] double memory_of(const SceneBlock& block);
/// @}

/// The array of a block, empty if absent or faulty. Reports counts and steps that differ in number, a count below 1,
/// and more than most_laid_blocks blocks in total.
[[nodiscard]] std::optional<SceneArray> read_array(TomlTableReader& block);

/// The blocks of an array: NAME.1, NAME.2, ..., the first direction fastest. Block (i, j, k), from 0, is the block
/// translated by i step[0] + j step[1] + k step[2], and by stagger if the last of its indices is odd. Planes and
/// points of its supports and loads are translated too.
[[nodiscard]] std::vector<SceneBlock> blocks_of_array(const SceneBlock& block);

}  // namespace ashlar
