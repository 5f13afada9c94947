// The initial stress of a scene as a field, and the start of its blocks.
#pragma once

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"
#include "mechanics/material/initial_stress.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Stress at places of a block (Pa, tension positive); empty: none. With k0 the vertical stress is minus the weight
/// above, unit_weight times the height up to the surface, along gravity, and the stress across is k0 times it; none
/// above the surface. None in blocks that the stage, or one before it, has
/// added. @param block,stage indices
[[nodiscard]] StressField initial_stress_of(const Scene& scene, std::size_t block, std::size_t stage);

/// Starts blocks under the initial stress of a scene. Warns of a stress that neither joints nor boundaries hold.
void start_under_stress(const Scene& scene, Simulation& simulation, Diagnostics& diagnostics);

}  // namespace ashlar
