// Solids of which rounding leaves no shape.
#pragma once

#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Whether the resolution that a solid was built with has left nothing of its shape: fewer than four faces,
/// or a face whose outline is missing or has fewer than three corners. Faces of a body hardly thicker than
/// the resolution close up so; contact has no features there.
[[nodiscard]] bool is_lost_in_rounding(const Polyhedron& solid);

}  // namespace ashlar
