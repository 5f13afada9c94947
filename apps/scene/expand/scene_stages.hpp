// Converts a scene of several stages to one scene for each of them: construction and excavation as successive
// analyses.
//
// Blocks keep their numbers through all stages; those missing in a stage are `absent` in its scene. Supports, loads,
// joints and materials of a stage apply to it and all later ones. A history applies to the stage in which it is
// given, with times from its start: later the load keeps its value at the end of that stage, and the support is at
// rest. Histories of [[block]] are those of the first stage with the block. A gravity_history of [analysis] applies
// to every stage without another one.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/expanded_scene.hpp"

namespace ashlar {

/// True if a name or glob of a stage matches a block: its name, or that of the block of which it is a piece.
[[nodiscard]] bool means_block(const Scene& scene, const std::string& pattern, std::size_t block);
/// The same for any of some patterns.
[[nodiscard]] bool means_block(const Scene& scene, const std::vector<std::string>& patterns,
                               std::size_t block);

/// True for the blocks absent before the first stage: those that are added before they are ever removed. Lists by
/// place (SceneStage::remove_inside) are ignored.
[[nodiscard]] std::vector<bool> held_back(const Scene& scene);

/// Applies the lists of a stage to the blocks absent before it.
void change_presence(const Scene& scene, const SceneStage& stage, std::vector<bool>& absent);

/// The scene of one stage, with all stages still listed; the scene itself if it has none. Places refer to the keys of
/// the stages.
/// @param stage index into whole.stage
[[nodiscard]] ExpandedScene scene_of_stage(const ExpandedScene& whole, std::size_t stage);

/// Calls `look` with the scene of each stage in turn; with the scene itself if it has none. Each is derived from the
/// one before, so that the time is linear in the number of stages.
void for_each_stage(const ExpandedScene& whole, const std::function<void(const ExpandedScene&)>& look);

/// Number of scenes from scene_of_stage: the number of stages, or 1.
[[nodiscard]] std::size_t stage_count(const Scene& scene);

/// Reports names given twice; patterns that match no block; removal of absent blocks, addition of present ones;
/// supports and loads of fixed blocks; unknown materials; joints that tie; keys that apply to the whole run only
/// (formulation, initial_state), and searches for a factor.
/// @param scene whose cuts have been made (cut_scene)
void check_stages(const Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar
