#include "apps/scene_loading.hpp"

#include "apps/available_features.hpp"
#include "apps/idle_keys.hpp"
#include "apps/initial_overlap.hpp"
#include "apps/scene_checks.hpp"
#include "apps/scene_limits.hpp"
#include "apps/scene_reader.hpp"
#include "apps/scene_solids.hpp"
#include "apps/soft_blocks.hpp"

namespace ashlar {

std::optional<LoadedScene> load_scene(const std::filesystem::path& file,
                                      const std::vector<std::string>& overrides, Diagnostics& diagnostics) {
  LoadedScene loaded{read_scene(file, overrides, diagnostics), {}, {}};
  check_references(loaded.scene, diagnostics);
  check_availability(loaded.scene, diagnostics);
  std::vector<std::optional<Polyhedron>> solids = build_solids(loaded.scene, diagnostics, &loaded.shapes);
  check_placement(loaded.scene, solids, diagnostics);
  check_limits(loaded.scene, solids, diagnostics);
  check_initial_overlap(loaded.scene, solids, diagnostics);
  if (!diagnostics.good()) return std::nullopt;
  warn_of_idle_keys(loaded.scene, diagnostics);
  warn_of_soft_blocks(loaded.scene, solids, diagnostics);
  for (std::optional<Polyhedron>& solid : solids) loaded.solids.push_back(std::move(*solid));
  return loaded;
}

}  // namespace ashlar
