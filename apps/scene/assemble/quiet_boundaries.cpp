#include "apps/scene/assemble/quiet_boundaries.hpp"

#include <fmt/format.h>

#include <utility>

#include "apps/scene/assemble/block_material.hpp"
#include "apps/scene/expand/ground_of_scene.hpp"

namespace ashlar {
namespace {

/// The column beside a boundary; none where nothing moves it.
SideColumn column_beside(const Scene& scene, const std::vector<GroundBoundary>& boundaries,
                         std::size_t boundary, const std::vector<Polyhedron>& solids,
                         const SimulationSettings& settings, Diagnostics& diagnostics) {
  const auto base = base_of_side(boundaries, boundary);
  if (boundaries[boundary].kind != GroundBoundary::Kind::free_field || !base ||
      boundaries[*base].wave.empty() || is_static(scene.analysis))
    return {};
  const SideLayers found =
      layers_beside(boundaries[boundary].plane, boundaries[*base].plane, ground_blocks_of(scene, solids));
  if (found.fault) {
    diagnostics.error(scene.places.value(fmt::format("boundary.{}.plane", boundary)),
                      fmt::format("free-field has no column of ground ({})", words_of(*found.fault)));
    return {};
  }
  std::vector<GroundLayer> layers;
  for (const auto& [bottom, top, block] : found.layers)
    layers.push_back({bottom, top, material_of(scene, block), scene.block[block].order});
  return side_column(boundaries[*base].plane, std::move(layers), boundaries[*base].wave, settings,
                     scene.analysis.end_time);
}

}  // namespace

QuietBoundaries::QuietBoundaries(const Scene& scene, const std::vector<Polyhedron>& solids,
                                 const SimulationSettings& settings, Diagnostics& diagnostics)
    : boundaries_(ground_boundaries_of(scene)) {
  for (std::size_t i = 0; i < boundaries_.size(); ++i)
    columns_.push_back(column_beside(scene, boundaries_, i, solids, settings, diagnostics));
}

std::vector<QuietFaces> QuietBoundaries::of_block(const Scene& scene, const Polyhedron& solid,
                                                  std::size_t block) const {
  std::vector<QuietFaces> result;
  if (scene.block[block].fixed || boundaries_.empty()) return result;
  const Material material = material_of(scene, block);
  for (std::size_t i = 0; i < boundaries_.size(); ++i)
    if (auto faces = quiet_faces_of(boundaries_[i], columns_[i], solid, material, scene.analysis.gravity))
      result.push_back(std::move(*faces));
  return result;
}

}  // namespace ashlar
