// A scene of several stages as one scene for each of them: construction and excavation, one analysis after the
// other.
//
// Blocks keep their numbers through all stages; those that are not there in a stage are `absent` in its scene.
// Supports, loads, joints and materials of a stage hold in it and in all later ones. A history is that of the
// stage that it is given in, with times from its start: later on the load stays what it was at the end of that
// stage, and the support rests. Histories of [[block]] are those of the first stage that the block is in. A
// gravity_history of [analysis] is that of every stage that does not give another one.
#pragma once

#include <functional>
#include <string>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"

namespace ashlar {

/// Whether a name or glob of a stage means a block: its name, or that of the block that it is a piece of.
[[nodiscard]] bool means_block(const Scene& scene, const std::string& pattern, std::size_t block);

/// The scene of one stage, with the stages of the whole still listed; the scene itself if it has none. Places
/// lead to the keys of the stages.
/// @param stage index into whole.stage
[[nodiscard]] Scene scene_of_stage(const Scene& whole, std::size_t stage);

/// Looks at the scene of each stage in turn; at the scene itself if it has none. Each is made from the one before, so
/// that the time goes with the number of stages.
void for_each_stage(const Scene& whole, const std::function<void(const Scene&)>& look);

/// Number of scenes that a scene stands for: that of its stages, or 1.
[[nodiscard]] std::size_t stage_count(const Scene& scene);

/// Reports: names given twice; patterns that mean no block; blocks removed that are not there, or added that
/// are; supports and loads of fixed blocks; materials that no [[material]] has named; joints that tie; what
/// only the whole run can have (formulation, initial_state), and searches for a factor.
/// To be called when blocks have been cut.
void check_stages(const Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar
