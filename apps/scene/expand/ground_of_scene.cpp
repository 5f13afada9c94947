#include "apps/scene/expand/ground_of_scene.hpp"

#include <fmt/format.h>

namespace ashlar {

std::vector<GroundBlock> ground_blocks_of(const Scene& scene, const std::vector<const Polyhedron*>& solids) {
  std::vector<GroundBlock> blocks;
  for (std::size_t k = 0; k < solids.size(); ++k)
    blocks.push_back({solids[k], scene.block[k].fixed, scene.absent.empty() || !scene.absent[k]});
  return blocks;
}

std::vector<GroundBlock> ground_blocks_of(const Scene& scene, const std::vector<Polyhedron>& solids) {
  std::vector<const Polyhedron*> of_blocks;
  for (const Polyhedron& solid : solids) of_blocks.push_back(&solid);
  return ground_blocks_of(scene, of_blocks);
}

std::vector<GroundBoundary> ground_boundaries_of(const Scene& scene) {
  std::vector<GroundBoundary> boundaries;
  for (const SceneBoundary& given : scene.boundary) {
    GroundBoundary& boundary = boundaries.emplace_back();
    boundary.plane = {given.plane.point, given.plane.normal};
    boundary.kind = given.kind == SceneBoundary::Kind::quiet ? GroundBoundary::Kind::quiet
                                                             : GroundBoundary::Kind::free_field;
    for (const auto& [time, velocity] : given.wave) {
      boundary.wave.times.push_back(time);
      boundary.wave.velocity.push_back(velocity);
    }
  }
  return boundaries;
}

std::string words_of(const SideLayersFault& fault) {
  switch (fault.kind) {
    case SideLayersFault::Kind::no_face:
      return "no block is beside it";
    case SideLayersFault::Kind::above_base:
      return fmt::format("its faces begin {:.3g} m above the base", fault.bottom);
    case SideLayersFault::Kind::too_low:
      return fmt::format("its faces are lower than {:.3g} m, to which the largest block beside it is known",
                         fault.bottom);
    case SideLayersFault::Kind::gap:
      return fmt::format("no face is between {:.6g} m and {:.6g} m above the base", fault.bottom, fault.top);
  }
  return "";
}

}  // namespace ashlar
