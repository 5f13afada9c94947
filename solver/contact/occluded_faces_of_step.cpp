#include "solver/contact/occluded_faces_of_step.hpp"

#include <algorithm>

#include "geometry/boxes/box_pairs.hpp"
#include "geometry/index.hpp"

namespace ashlar {

OccludedFacesOfStep::OccludedFacesOfStep(std::vector<bool> fixed, const SimulationSettings& settings)
    : fixed_(std::move(fixed)),
      flush_{settings.contact_distance, settings.contact_distance, settings.search.contact_angle} {}

OccludedFaces OccludedFacesOfStep::between_fixed_blocks(const std::vector<BlockSurface>& surfaces) const {
  OccludedFaces sides;
  std::vector<Box> boxes(surfaces.size());
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    if (fixed_[k]) boxes[k] = box_of(surfaces[k].surface().points).grown(flush_.reach);
  }
  for (const PairKey& pair : meeting_boxes(boxes)) {
    const SubFaceSurface& a = surfaces[at(pair[0])].surface();
    const SubFaceSurface& b = surfaces[at(pair[1])].surface();
    const PairContacts contacts =
        find_contacts(PlacedSurface(a, a.points), PlacedSurface(b, b.points), flush_);
    sides.add(pair, contacts.overlaps, a, b, flush_.reach);
  }
  return sides;
}

void OccludedFacesOfStep::note(const std::vector<PairOfContacts>& contacts,
                               const std::vector<BlockSurface>& surfaces) {
  of_step_.emplace();
  const bool any_inside = std::any_of(contacts.begin(), contacts.end(), [](const PairOfContacts& pair) {
    return std::any_of(pair.second->vertices.begin(), pair.second->vertices.end(),
                       [](const VertexContact& contact) { return contact.gap < 0.0; });
  });
  if (!any_inside) return;
  if (!of_fixed_) of_fixed_ = between_fixed_blocks(surfaces);
  of_step_ = *of_fixed_;
  for (const auto& [blocks, of_pair] : contacts) {
    of_step_->add(blocks, of_pair->overlaps, surfaces[at(blocks[0])].surface(),
                  surfaces[at(blocks[1])].surface(), flush_.reach);
  }
}

}  // namespace ashlar
