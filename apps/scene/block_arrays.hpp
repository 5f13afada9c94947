// array = { count, step, stagger }: one [[block]] laid out many times.
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/scene.hpp"
#include "apps/scene/toml_table_reader.hpp"

namespace ashlar {

/// Blocks that arrays and masonry of one scene may come to.
inline constexpr int most_laid_blocks = 20'000;

/// Bytes that the copies of blocks, supports and loads of one scene may come to.
inline constexpr double most_laid_memory = 2e8;

/// What a copy of a block, a support or a load takes, about, in bytes.
/// @{
[[nodiscard]] double memory_of(const SceneFix& fix);
[[nodiscard]] double memory_of(const SceneLoad& load);
[[nodiscard]] double memory_of(const SceneBlock& block);
/// @}

/// The array of a block, none if absent or faulty. Reported: counts and steps that differ in number, a count
/// below 1, more than most_laid_blocks blocks in all.
[[nodiscard]] std::optional<SceneArray> read_array(TomlTableReader& block);

/// The blocks of an array: NAME.1, NAME.2, ..., the first direction fastest. Block (i, j, k), from 0, is the
/// block itself moved by i step[0] + j step[1] + k step[2], and by stagger where the last of its indices is
/// odd; planes and points of its supports and loads move along.
[[nodiscard]] std::vector<SceneBlock> blocks_of_array(const SceneBlock& block);

}  // namespace ashlar
