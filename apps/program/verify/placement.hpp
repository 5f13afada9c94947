// Verification scenes rotated and translated as a whole: results must transform likewise.
#pragma once

#include "apps/scene/assemble/scene_placement.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

using Placement = ScenePlacement;

/// A general placement: rotation of 0.8 rad about (1, 2, 3), translation by (12, -30, 5).
[[nodiscard]] Placement some_placement();

/// Rotates and translates material points: x -> turn x + shift, with the same faces.
[[nodiscard]] Polyhedron placed(const Polyhedron& solid, const Placement& placement);

/// A block with its shape, supports, loads and points, rotated and translated as a whole.
/// @throws std::invalid_argument if the placement has a rotation and a support fixes some components only: these are
/// along the axes of space, and the rotated support would fix another direction
[[nodiscard]] BlockDefinition placed(BlockDefinition block, const Placement& placement);

/// Rotates velocities.
[[nodiscard]] InitialMotion placed(const InitialMotion& motion, const Placement& placement);

}  // namespace ashlar
