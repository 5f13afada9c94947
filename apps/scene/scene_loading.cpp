#include "apps/scene/scene_loading.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "apps/scene/base_motion.hpp"
#include "apps/scene/doubtful_keys.hpp"
#include "apps/scene/idle_keys.hpp"
#include "apps/scene/initial_overlap.hpp"
#include "apps/scene/scene_checks.hpp"
#include "apps/scene/scene_cuts.hpp"
#include "apps/scene/scene_limits.hpp"
#include "apps/scene/scene_reader.hpp"
#include "apps/scene/scene_solids.hpp"
#include "apps/scene/scene_stages.hpp"
#include "apps/scene/soft_blocks.hpp"

namespace ashlar {
namespace {

/// A key of [analysis] is idle if it is so in every stage.
void warn_of_keys_idle_in_all(const std::vector<const Scene*>& stages, Diagnostics& diagnostics) {
  std::vector<Diagnostic> idle;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    Diagnostics found;
    warn_of_idle_keys(*stages[k], found);
    const std::vector<Diagnostic> here = found.sorted();
    if (k == 0) idle = here;
    std::erase_if(idle, [&](const Diagnostic& warning) {
      return std::none_of(here.begin(), here.end(), [&](const Diagnostic& other) {
        return other.place == warning.place && other.message == warning.message;
      });
    });
  }
  for (const Diagnostic& warning : idle) diagnostics.warning(warning.place, warning.message);
}

/// Of all stages: pairs that may overlap, each once.
std::vector<KnownOverlap> check_overlaps(const std::vector<const Scene*>& stages,
                                         const std::vector<std::optional<Polyhedron>>& solids,
                                         Diagnostics& diagnostics) {
  std::map<std::array<int, 2>, KnownOverlap> known;
  for (const Scene* stage : stages)
    for (const KnownOverlap& overlap : check_initial_overlap(*stage, solids, diagnostics))
      known.emplace(overlap.blocks, overlap);
  std::vector<KnownOverlap> result;
  result.reserve(known.size());
  for (const auto& [blocks, overlap] : known) result.push_back(overlap);
  return result;
}

/// Checks and builds what was read.
std::optional<LoadedScene> loaded(Scene scene, Diagnostics& diagnostics, Preparation* preparation,
                                  LoadPurpose purpose) {
  const auto phase = [&](const char* words) {
    if (preparation != nullptr) preparation->phase(words);
  };
  LoadedScene loaded{std::move(scene), {}, {}, {}, {}};
  check_cuts(loaded.scene, diagnostics);
  if (!loaded.scene.cut.empty()) {
    // Names of pieces are known once they are cut, and only what can be read is cut.
    if (!diagnostics.good() || !check_cost(loaded.scene, estimate_cost(loaded.scene), diagnostics))
      return std::nullopt;
    cut_scene(loaded.scene, diagnostics, preparation);
    if (!diagnostics.good()) return std::nullopt;
  }
  check_stages(loaded.scene, diagnostics);
  // What stages say of blocks that are not there has no meaning further on.
  if (!loaded.scene.stage.empty() && !diagnostics.good()) return std::nullopt;
  std::vector<Scene> made;
  for (std::size_t k = 0; k < loaded.scene.stage.size(); ++k) made.push_back(scene_of_stage(loaded.scene, k));
  std::vector<const Scene*> stages;
  for (const Scene& stage : made) stages.push_back(&stage);
  if (stages.empty()) stages.push_back(&loaded.scene);
  for (const Scene* stage : stages) check_references(*stage, diagnostics);
  // Nothing of a scene that is too large is built.
  if (purpose == LoadPurpose::run && !check_cost(loaded.scene, estimate_cost(loaded.scene), diagnostics))
    return std::nullopt;
  std::vector<std::optional<Polyhedron>> solids =
      build_solids(loaded.scene, diagnostics, &loaded.shapes, preparation);
  for (const Scene* stage : stages) {
    check_placement(*stage, solids, diagnostics);
    check_limits(*stage, solids, diagnostics);
  }
  warn_of_mesh_units(loaded.scene, solids, diagnostics);
  phase("overlaps of blocks");
  loaded.overlaps = check_overlaps(stages, solids, diagnostics);
  if (!diagnostics.good()) return std::nullopt;
  warn_of_known_overlaps(loaded.scene, loaded.overlaps, diagnostics);
  phase("sizes of the scene");
  loaded.cost = estimate_cost(loaded.scene, &solids);
  if (purpose == LoadPurpose::run && !check_cost(loaded.scene, loaded.cost, diagnostics)) return std::nullopt;
  warn_of_keys_idle_in_all(stages, diagnostics);
  for (const Scene* stage : stages) {
    warn_of_doubtful_keys(*stage, diagnostics);
    warn_of_jumping_supports(*stage, diagnostics);
    warn_of_soft_blocks(*stage, solids, diagnostics);
  }
  for (std::optional<Polyhedron>& solid : solids) loaded.solids.push_back(std::move(*solid));
  return loaded;
}

}  // namespace

std::optional<LoadedScene> load_scene(const std::filesystem::path& file,
                                      const std::vector<std::string>& overrides, Diagnostics& diagnostics,
                                      Preparation* preparation, LoadPurpose purpose) {
  return loaded(read_scene(file, overrides, diagnostics), diagnostics, preparation, purpose);
}

std::optional<LoadedScene> load_scene_text(std::string_view text, const std::filesystem::path& file,
                                           const std::vector<std::string>& overrides,
                                           Diagnostics& diagnostics) {
  return loaded(parse_scene(text, file, overrides, diagnostics), diagnostics, nullptr, LoadPurpose::run);
}

LoadedScene stage_of(const LoadedScene& whole, std::size_t stage) {
  return {scene_of_stage(whole.scene, stage), whole.solids, whole.shapes, whole.cost, whole.overlaps};
}

}  // namespace ashlar
