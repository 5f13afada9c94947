// Touches with sides that lie on a third block (occluded_faces.hpp).
#pragma once

#include <vector>

#include "geometry/contacts/motion_check.hpp"

namespace ashlar {

/// A vertex that goes into a block through a side that is hidden has gone in below one of the faces beside
/// it: where it ends least deep. A touch with a hidden side becomes one with that face, each once, or none if
/// the vertex ends outside.
void turn_to_open_faces(const MovingSurface& a, const MovingSurface& b, const OccludedPlaces& hidden,
                        std::vector<Touch>& touches);

}  // namespace ashlar
