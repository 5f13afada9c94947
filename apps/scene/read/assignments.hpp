// [[assign]]: properties of blocks assigned by patterns of their names, after the blocks.
#pragma once

#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Applies the scene's assignments without a region to blocks: the last matching one has priority, key by key. Supports and loads are
/// added to those of a block. An arch's fill does not load a fixed voussoir. Places of assigned values are those of
/// the assignment.
/// @param diagnostics reports a pattern that matches no block, unless there are cuts, whose pieces it may match;
/// entries that need more than about a second or most_laid_memory for their blocks; supports, loads and velocities of
/// a block that becomes fixed.
void apply_assignments(Scene& scene, Diagnostics& diagnostics);

/// Applies assignments to the pieces that patterns match, except those of a block matched by the same pattern, which
/// have inherited everything from it, and to the blocks of regions.
/// @param scene whose cuts have been made (cut_scene) and whose regions have their blocks (choose_blocks_inside)
void apply_later_assignments(Scene& scene, Diagnostics& diagnostics);

/// The pieces changed by apply_later_assignments, by assignment, as indices of blocks.
[[nodiscard]] std::vector<std::vector<std::size_t>> assigned_pieces(const Scene& scene);

}  // namespace ashlar
