// [[assign]]: properties of blocks by the patterns of their names, given after the blocks.
#pragma once

#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"
#include "apps/scene/toml_table_reader.hpp"

namespace ashlar {

[[nodiscard]] SceneAssign read_assignment(TomlTableReader& table);

/// Gives blocks what the scene's assignments say: the last one that matches counts, key by key; supports and
/// loads are added to those that a block has; an arch's fill does not load a voussoir that is fixed. Places
/// of what was assigned are those of the assignment.
/// Reported: a pattern that matches no block, unless there are cuts, whose pieces it may mean; entries that
/// would take more than about a second or most_laid_memory for their blocks; supports, loads and velocities
/// of a block that is fixed then.
void apply_assignments(Scene& scene, Diagnostics& diagnostics);

/// After the cuts: the same to the pieces that patterns match, but for those of a block that the same pattern
/// has matched, which have everything from it.
void apply_assignments_to_pieces(Scene& scene, Diagnostics& diagnostics);

/// The pieces that apply_assignments_to_pieces gives something, by assignment, as indices of blocks.
[[nodiscard]] std::vector<std::vector<std::size_t>> assigned_pieces(const Scene& scene);

}  // namespace ashlar
