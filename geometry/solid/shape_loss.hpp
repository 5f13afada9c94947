// Solids whose shape is lost by rounding.
#pragma once

#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// True if the resolution of a solid has left no valid shape: fewer than four faces, or a face whose outline is
/// missing or has fewer than three corners. This happens to faces of a body hardly thicker than the resolution; it
/// has no features for contact.
[[nodiscard]] bool is_lost_in_rounding(const Polyhedron& solid);

}  // namespace ashlar
