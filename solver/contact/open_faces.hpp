// Touches with occluded sides of blocks (occluded_faces.hpp).
#pragma once

#include <vector>

#include "geometry/contacts/motion_check.hpp"

namespace ashlar {

/// A vertex that enters a block through an occluded side has entered below one of the adjacent faces: the one where
/// it ends least deep. A touch with an occluded side is replaced by one with that face, without duplicates, or
/// removed if the vertex ends outside.
void turn_to_open_faces(const MovingSurface& a, const MovingSurface& b, const OccludedPlaces& hidden,
                        std::vector<Touch>& touches);

}  // namespace ashlar
