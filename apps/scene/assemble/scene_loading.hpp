// From a scene file and its overrides to a checked scene with its solids, for `run` and `check`.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/check/cost_estimate.hpp"
#include "apps/scene/check/initial_overlap.hpp"
#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/expanded_scene.hpp"
#include "apps/scene/model/preparation.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

struct ScenePlacement;

struct LoadedScene {
  ExpandedScene scene;
  std::vector<Polyhedron> solids;  ///< one per scene.block, placed
  /// One per scene.block, before translation; equal ones are shared.
  std::vector<std::shared_ptr<const Polyhedron>> shapes;
  CostEstimate cost;                   ///< of all blocks of all stages, on each rank
  std::vector<KnownOverlap> overlaps;  ///< accepted by contact.allowed_overlap, by pair
  std::size_t stage = 0;               ///< of one stage: its index in scene.stage
};

/// One stage of a scene (scene_stages.hpp), or the scene itself if it has none.
[[nodiscard]] LoadedScene stage_of(const LoadedScene& whole, std::size_t stage);

enum class LoadPurpose {
  run,  ///< a scene may be refused for the cost of a run
  /// Only the blocks are needed: unknown names in stages, assignments, joints and measures cause warnings, as the
  /// names of pieces are known once they are listed.
  blocks,
};

/// Reads, overrides, checks and builds; see scene_reader.hpp, scene_checks.hpp, scene_solids.hpp. For warnings see
/// soft_blocks.hpp, idle_keys.hpp. Each stage of a scene is checked.
/// @param overrides "key.path=value" each, as given to --set, applied in order.
/// @param preparation receives the present phase, if not null. @param ranks that share a run of the scene
/// @param placement of the scene that was read (scene_placement.hpp, with the exceptions of placed()), if not null
/// @return empty if the scene has any error; all of them are then in diagnostics. Writes no file.
[[nodiscard]] std::optional<LoadedScene> load_scene(const std::filesystem::path& file,
                                                    const std::vector<std::string>& overrides,
                                                    Diagnostics& diagnostics,
                                                    Preparation* preparation = nullptr,
                                                    LoadPurpose purpose = LoadPurpose::run, int ranks = 1,
                                                    const ScenePlacement* placement = nullptr);

/// The same from the text of a scene. @param file name for messages and folder of its paths
[[nodiscard]] std::optional<LoadedScene> load_scene_text(std::string_view text,
                                                         const std::filesystem::path& file,
                                                         const std::vector<std::string>& overrides,
                                                         Diagnostics& diagnostics,
                                                         Preparation* preparation = nullptr, int ranks = 1);

}  // namespace ashlar
