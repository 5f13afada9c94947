#include "apps/scene/assemble/scene_loading.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "apps/scene/assemble/scene_placement.hpp"
#include "apps/scene/assemble/scene_reader.hpp"
#include "apps/scene/check/boundary_checks.hpp"
#include "apps/scene/check/initial_overlap.hpp"
#include "apps/scene/check/scene_checks.hpp"
#include "apps/scene/check/scene_limits.hpp"
#include "apps/scene/check/support_checks.hpp"
#include "apps/scene/check/warnings/base_motion.hpp"
#include "apps/scene/check/warnings/idle_keys.hpp"
#include "apps/scene/check/warnings/implausible_keys.hpp"
#include "apps/scene/check/warnings/soft_blocks.hpp"
#include "apps/scene/expand/moving_loads.hpp"
#include "apps/scene/expand/region_blocks.hpp"
#include "apps/scene/expand/scene_cuts.hpp"
#include "apps/scene/expand/scene_solids.hpp"
#include "apps/scene/expand/scene_stages.hpp"
#include "apps/scene/read/assignments.hpp"

namespace ashlar {
namespace {

/// Warns of keys of [analysis] without effect in every stage.
void warn_of_keys_idle_in_all(const ExpandedScene& whole, Diagnostics& diagnostics) {
  std::optional<std::vector<Diagnostic>> idle;
  for_each_stage(whole, [&](const ExpandedScene& stage) {
    if (idle && idle->empty()) return;
    Diagnostics found;
    warn_of_idle_keys(stage, found);
    const std::vector<Diagnostic> here = found.sorted();
    if (!idle) idle = here;
    std::erase_if(*idle, [&](const Diagnostic& warning) {
      return std::none_of(here.begin(), here.end(), [&](const Diagnostic& other) {
        return other.place == warning.place && other.message == warning.message;
      });
    });
  });
  for (const Diagnostic& warning : *idle) diagnostics.warning(warning.place, warning.message);
}

/// Blocks present together in several stages are checked in the first of them.
/// @return pairs that may overlap, each once
std::vector<KnownOverlap> check_overlaps(const ExpandedScene& whole,
                                         const std::vector<std::optional<Polyhedron>>& solids,
                                         Diagnostics& diagnostics) {
  std::optional<std::vector<bool>> looked_at;
  std::map<PairKey, KnownOverlap> known;
  for_each_stage(whole, [&](const ExpandedScene& stage) {
    if (looked_at == stage.absent) return;
    looked_at = stage.absent;
    for (const KnownOverlap& overlap : check_initial_overlap(stage, solids, diagnostics))
      known.emplace(overlap.blocks, overlap);
  });
  std::vector<KnownOverlap> result;
  result.reserve(known.size());
  for (const auto& [blocks, overlap] : known) result.push_back(overlap);
  return result;
}

/// Expands a scene that was read: cuts, blocks by place, assignments by name. @param of_blocks faults of names of blocks
/// @return empty after a fault that leaves nothing to check
std::optional<ExpandedScene> expanded(Scene scene, Diagnostics& diagnostics, Diagnostics& of_blocks,
                                      Preparation* preparation, int ranks) {
  check_cuts(scene, diagnostics);
  if (!scene.cut.empty()) {
    // Names of pieces are known after the cuts, which need a valid scene.
    if (!diagnostics.good() || !check_cost(scene, estimate_cost(scene, nullptr, ranks), diagnostics))
      return std::nullopt;
    cut_scene(scene, diagnostics, preparation);
    if (!diagnostics.good()) return std::nullopt;
  }
  if (has_regions(scene)) {
    if (!diagnostics.good()) return std::nullopt;
    choose_blocks_inside(scene, of_blocks, preparation);
    if (!diagnostics.good()) return std::nullopt;
  }
  apply_later_assignments(scene, of_blocks);
  if (!scene.cut.empty() && !diagnostics.good()) return std::nullopt;
  check_stages(scene, of_blocks);
  // Statements of stages about absent blocks have no meaning further on.
  if (!scene.stage.empty() && !diagnostics.good()) return std::nullopt;
  return ExpandedScene(std::move(scene));
}

/// Expands, checks and builds a scene that was read.
std::optional<LoadedScene> loaded(Scene scene, Diagnostics& diagnostics, Preparation* preparation,
                                  LoadPurpose purpose, int ranks) {
  const auto phase = [&](const char* words) {
    if (preparation != nullptr) preparation->phase(words);
  };
  // Faults of names of blocks.
  Diagnostics of_names;
  Diagnostics& of_blocks = purpose == LoadPurpose::blocks ? of_names : diagnostics;
  std::optional<ExpandedScene> whole = expanded(std::move(scene), diagnostics, of_blocks, preparation, ranks);
  if (!whole) return std::nullopt;
  LoadedScene loaded{std::move(*whole), {}, {}, {}, {}, 0};
  if (!of_names.good()) loaded.scene.stage.clear();
  for_each_stage(loaded.scene,
                 [&](const ExpandedScene& stage) { check_references(stage, diagnostics, of_blocks); });
  for (const Diagnostic& fault : of_names.sorted()) diagnostics.warning(fault.place, fault.message);
  // A scene that is too large is not built.
  if (purpose == LoadPurpose::run &&
      !check_cost(loaded.scene, estimate_cost(loaded.scene, nullptr, ranks), diagnostics))
    return std::nullopt;
  std::vector<std::optional<Polyhedron>> solids =
      build_solids(loaded.scene, diagnostics, &loaded.shapes, preparation);
  lay_moving_loads(loaded.scene, solids, of_blocks);
  for_each_stage(loaded.scene, [&](const ExpandedScene& stage) {
    check_placement(stage, solids, diagnostics);
    check_limits(stage, solids, diagnostics);
    check_boundaries(stage, solids, diagnostics);
  });
  check_supports(loaded.scene, solids, diagnostics);
  warn_of_mesh_units(loaded.scene, solids, diagnostics);
  phase("overlaps of blocks");
  loaded.overlaps = check_overlaps(loaded.scene, solids, diagnostics);
  if (!diagnostics.good()) return std::nullopt;
  warn_of_known_overlaps(loaded.scene, loaded.overlaps, diagnostics);
  phase("sizes of the scene");
  loaded.cost = estimate_cost(loaded.scene, &solids, ranks);
  if (purpose == LoadPurpose::run && !check_cost(loaded.scene, loaded.cost, diagnostics)) return std::nullopt;
  warn_of_keys_idle_in_all(loaded.scene, diagnostics);
  warn_of_boundaries(loaded.scene, diagnostics);
  for_each_stage(loaded.scene, [&](const ExpandedScene& stage) {
    warn_of_implausible_keys(stage, diagnostics);
    warn_of_jumping_supports(stage, diagnostics);
    warn_of_soft_blocks(stage, solids, diagnostics);
  });
  for (std::optional<Polyhedron>& solid : solids) loaded.solids.push_back(std::move(*solid));
  return loaded;
}

}  // namespace

std::optional<LoadedScene> load_scene(const std::filesystem::path& file,
                                      const std::vector<std::string>& overrides, Diagnostics& diagnostics,
                                      Preparation* preparation, LoadPurpose purpose, int ranks,
                                      const ScenePlacement* placement) {
  Scene scene = read_scene(file, overrides, diagnostics);
  if (placement != nullptr && diagnostics.good()) scene = placed(std::move(scene), *placement);
  return loaded(std::move(scene), diagnostics, preparation, purpose, ranks);
}

std::optional<LoadedScene> load_scene_text(std::string_view text, const std::filesystem::path& file,
                                           const std::vector<std::string>& overrides,
                                           Diagnostics& diagnostics, Preparation* preparation, int ranks) {
  return loaded(parse_scene(text, file, overrides, diagnostics), diagnostics, preparation, LoadPurpose::run,
                ranks);
}

LoadedScene stage_of(const LoadedScene& whole, std::size_t stage) {
  return {scene_of_stage(whole.scene, stage), whole.solids, whole.shapes, whole.cost, whole.overlaps, stage};
}

}  // namespace ashlar
