// From a scene file and its overrides to a checked scene with its solids: what `run` and `check` start from.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/cost_estimate.hpp"
#include "apps/scene/diagnostics.hpp"
#include "apps/scene/initial_overlap.hpp"
#include "apps/scene/preparation.hpp"
#include "apps/scene/scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

struct LoadedScene {
  Scene scene;
  std::vector<Polyhedron> solids;  ///< one per scene.block, placed
  /// One per scene.block, before it was translated; equal ones are one.
  std::vector<std::shared_ptr<const Polyhedron>> shapes;
  CostEstimate cost;                   ///< with all blocks of all stages
  std::vector<KnownOverlap> overlaps;  ///< that contact.allowed_overlap accepts, by pair
};

/// One stage of a scene (scene_stages.hpp), or the scene itself if it has none.
[[nodiscard]] LoadedScene stage_of(const LoadedScene& whole, std::size_t stage);

enum class LoadPurpose {
  run,  ///< the cost of a run may refuse the scene
  /// Only its blocks are looked at: names in stages, assignments, joints and measures that none has are warned of, as the
  /// names of pieces are known once they are listed.
  blocks,
};

/// Reads, overrides, checks and builds; see scene_reader.hpp, scene_checks.hpp, scene_solids.hpp. Warnings:
/// soft_blocks.hpp, idle_keys.hpp. Of a scene of stages each stage is checked.
/// @param overrides "key.path=value" each, as given to --set, applied in order.
/// @param preparation is told what is at work, if there is one.
/// @return nothing if the scene has any error; all of them are then in diagnostics. Writes no file.
[[nodiscard]] std::optional<LoadedScene> load_scene(const std::filesystem::path& file,
                                                    const std::vector<std::string>& overrides,
                                                    Diagnostics& diagnostics,
                                                    Preparation* preparation = nullptr,
                                                    LoadPurpose purpose = LoadPurpose::run);

/// The same from the text of a scene. @param file names it in messages and gives the folder of its paths
[[nodiscard]] std::optional<LoadedScene> load_scene_text(std::string_view text,
                                                         const std::filesystem::path& file,
                                                         const std::vector<std::string>& overrides,
                                                         Diagnostics& diagnostics,
                                                         Preparation* preparation = nullptr);

}  // namespace ashlar
